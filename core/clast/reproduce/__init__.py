"""Reproductions: all studies of a publication, run by one command and told on one page."""

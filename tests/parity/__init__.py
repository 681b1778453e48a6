"""Comparison with MUSEN, the program of the paper's authors, number by number."""

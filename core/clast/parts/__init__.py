"""Kinds of parts: one file per kind, each saying what a part of that kind must offer."""

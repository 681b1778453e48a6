"""Judges of single contact laws; the family that holds them is ``families/contact_laws.py``."""

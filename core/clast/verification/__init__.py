"""Verification: scenes with known answers, run through the whole program and compared."""

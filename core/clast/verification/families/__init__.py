"""Families of cases, one file each; ``clast.verification.suite`` lists them."""

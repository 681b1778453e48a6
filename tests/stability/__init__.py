"""Stability under stress: scenes at the edge of what can be computed, and what becomes of them.

``python -m tests.stability`` runs them all and writes ``docs/stability.md``.
"""

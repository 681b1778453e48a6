"""Benchmarks: error against run time, speed beside a peer, what features cost, and how soon a user sees something.

``clast bench`` runs them and writes one page; pytest never measures: timings are no tests.
"""

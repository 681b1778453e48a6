"""Benchmarks: how fast Clast steps beside a peer, what each feature costs, and how soon a user sees something.

Run ``python -m tests.benchmarks`` (``--help`` lists the options). pytest never runs them: timings are no tests.
"""

"""Commands: what `clast run`, `check --build`, `verify`, `bench`, `write` and `view` do and print."""

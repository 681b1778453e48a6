"""Writing: the files that show a run, made by a process of its own."""

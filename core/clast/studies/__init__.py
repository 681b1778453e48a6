"""Studies: many runs of one scene with values varied, and what they say together."""

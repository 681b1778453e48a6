"""Granular mechanics of a bed of breakable grains, read off a run folder: grading, damage, cracks, profiles.

:func:`clast.granular.analysis.analyse` computes all of it; every other module holds one definition.
"""

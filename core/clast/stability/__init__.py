"""Stability: how large a time step a scene allows, from its springs, dashpots and masses."""

"""Calibration: parameters of a scene fitted to what was measured."""

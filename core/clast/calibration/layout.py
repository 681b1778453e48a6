"""Layout: which file of a calibration lies where in its folder."""

from __future__ import annotations

ASKED = "calibration.yaml"
"""The calibration as it was asked for."""

FITTED, HISTORY, RUNS = "fitted.yaml", "history.csv", "runs.csv"
PAGE, PICTURE, ACCOUNT = "calibration.md", "fit.png", "account.json"

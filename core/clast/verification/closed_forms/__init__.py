"""Closed forms that cases are compared with; each names its source."""

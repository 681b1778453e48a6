"""Configuration: one YAML file, checked and turned into a scene description in SI."""

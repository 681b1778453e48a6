"""From a config to particles, bonds and walls as plain arrays."""

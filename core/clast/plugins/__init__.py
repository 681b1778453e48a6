"""Plugins: the hook, the registry that holds every part, and how plugins are found."""

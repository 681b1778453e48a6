"""Starting files of parts, one a kind: plugins as they stand, which ``clast plugins new`` copies under another name."""

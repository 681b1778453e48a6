"""The packages beside this file are built and installed by the test, not collected."""

collect_ignore_glob = ["clast-*"]

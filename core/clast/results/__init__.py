"""What a run leaves behind: results, checkpoints, curves, summary."""

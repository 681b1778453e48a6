"""Bond kinematics, one per file."""

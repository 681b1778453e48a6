"""How far each limit of the time step is from the true one: ``python -m tests.limits`` writes docs/time-step.md."""

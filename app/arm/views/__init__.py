"""The simulated arm carries out the student's own plan, in the window."""

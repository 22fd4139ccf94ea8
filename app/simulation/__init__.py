"""Scene compiler, effects, the simulated robot and the scripted trainee."""

"""An hour of random motion in scenes that change every five seconds; see `soak`."""

"""Motion of the simulated arm: pivoting, Cartesian motion, timing, search, pick and place."""

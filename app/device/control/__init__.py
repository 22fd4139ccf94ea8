"""Virtual fixtures, force limits, safety and the real-time loop."""

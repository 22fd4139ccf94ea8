"""What accuracy costs, in the window: the scene that runs, and every study."""

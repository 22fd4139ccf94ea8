"""The robot in the window: which one, how it is, and its commissioning."""

"""The haptic robot: control and links."""

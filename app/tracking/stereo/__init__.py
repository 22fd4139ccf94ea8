"""From two pixels to one point."""

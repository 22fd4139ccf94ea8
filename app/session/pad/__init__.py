"""The pad: the plane across the path in which the hand is seen and moved."""

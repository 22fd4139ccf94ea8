"""What the ways of a study are measured against: closed forms, bounds and other programs."""

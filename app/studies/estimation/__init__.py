"""Parts of the study `velocity`: motions of a hand and their measurement."""

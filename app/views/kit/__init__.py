"""Parts that every feature of the window shares."""

"""Live links in the window: how they are, and plans that a peer sends."""

"""The 3D view: surfaces, robot, needle and path, drawn off-screen beside the window."""

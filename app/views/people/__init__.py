"""People in the window: signing in, students, courses, the board of progress."""

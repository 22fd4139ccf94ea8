"""Everything the student sees while inserting: the pad, the panel, the status strip, the cameras."""

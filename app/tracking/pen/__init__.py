"""A needle for a student without a robot: printed markers on a pen, seen by one webcam."""

"""What the student sees while inserting: pad, panel, status strip, camera pictures."""

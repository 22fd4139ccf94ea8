"""What an exercise is: schema and library."""

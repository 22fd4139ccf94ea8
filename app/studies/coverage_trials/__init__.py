"""What the study `coverage` tries: chains of calibrations, and registrations."""

"""Plans, placement of the patient in the robot frame, reach."""

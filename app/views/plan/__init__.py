"""Editing the plan and the patient's position, with the robot's verdict on both."""

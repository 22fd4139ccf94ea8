"""The gimbal."""

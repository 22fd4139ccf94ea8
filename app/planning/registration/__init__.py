"""Point-based registration: fiducials touched or picked, and how good the result is at a target."""

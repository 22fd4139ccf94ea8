"""Making a calibration: boards, corners, pairing, one camera, two cameras, validation."""

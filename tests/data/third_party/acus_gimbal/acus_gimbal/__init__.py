"""All that a gimbal needs in Acus."""

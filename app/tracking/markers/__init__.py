"""Finding the red band in a picture, in several named ways."""

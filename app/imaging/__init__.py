"""CT in: series reading, volumes, slicing, windowing and the phantom patient."""

from app.imaging.quiet import silence

silence()

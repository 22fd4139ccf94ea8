"""CT in: series reading, volumes, slicing, windowing and the phantom patient."""

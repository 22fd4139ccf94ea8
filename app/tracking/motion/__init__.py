"""How the needle moves along itself between the cameras' fixes, in several named ways."""

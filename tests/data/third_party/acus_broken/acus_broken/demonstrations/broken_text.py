"""No Python."""

DECLARATION = {

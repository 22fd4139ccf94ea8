"""The twin laboratory: every part of a set-up on one computer, each killed, hung and restarted."""

"""What is shown after an attempt: score, curves, report, and the list of recorded sessions."""

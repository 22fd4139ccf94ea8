"""The daily check: what is looked at, what it means, and what to do about it."""

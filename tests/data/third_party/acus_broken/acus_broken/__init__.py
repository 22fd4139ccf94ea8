"""Nothing in here works."""

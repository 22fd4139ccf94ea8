"""Whether a board keeps docs/protocol.md: what is asked of it, and what it answered."""

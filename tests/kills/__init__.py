"""Programs that are killed while they change what is kept, and what the next start finds."""

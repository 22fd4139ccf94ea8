"""Live links: what runs now, told to other programs while it runs, each in threads of its own."""

"""Wire protocols and simulated links."""

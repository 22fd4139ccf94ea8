"""What the arm's studies are measured against or compared with."""

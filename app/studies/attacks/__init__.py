"""Attempts that want points for what earns none: described, searched for, kept."""

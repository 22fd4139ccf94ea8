"""Machines in the table of `acus study machines`, beside the pantograph: one a file."""

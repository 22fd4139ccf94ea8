"""The arm in the table of machines."""

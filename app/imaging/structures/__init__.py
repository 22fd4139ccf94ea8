"""Structures: what of a patient is a vessel, a rib, a lesion; read, drawn, measured and written."""

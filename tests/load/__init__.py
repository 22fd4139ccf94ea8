"""Stations of a school that share a store, under load: killed, cut off, put back, and compared."""

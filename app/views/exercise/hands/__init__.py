"""Hands without a device: what moves the simulated hand, one file each."""

"""Rigid transforms, frames, units, clock, latest value, state vector, errors, configuration."""

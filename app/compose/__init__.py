"""Builds a running trainer from a configuration; `trainer` alone names concrete drivers."""

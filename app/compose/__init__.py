"""Builds a running trainer from a configuration; `trainer` alone names concrete drivers."""

from app.compose.desktop import Desktop

__all__ = ["Desktop"]

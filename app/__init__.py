"""Acus: a desktop trainer for CT-guided needle insertion. Training only, not a medical device."""

__version__ = "0.1.0"

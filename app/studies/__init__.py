"""Accuracy against time: one study per file, one runner, one plot."""

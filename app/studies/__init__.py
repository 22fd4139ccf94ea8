"""Accuracy against time: one study per file, one runner, one table, one picture.

A file of this folder that defines `STUDY` is a study. See 'How to add a study' in
docs/architecture.md.
"""

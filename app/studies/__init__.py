"""Accuracy against time: one study per file, one runner, one table, one picture.

A file of this folder that declares itself and defines `STUDY` is a study: a `Study` compares ways
by error and time, a `Survey` answers by maps and tables. Folders hold what studies need beside
their files. See 'How to add a study' in docs/extending.md.
"""

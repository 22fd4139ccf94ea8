"""Accuracy against time: one study per file, one runner, one table, one picture.

A file of this folder that defines `STUDY` is a study: a `Study` compares ways by error and time, a
`Survey` answers by maps and tables. Folders hold what one study needs beside its file.
See 'How to add a study' in docs/extending.md.
"""

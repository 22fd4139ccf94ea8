"""The path report of a lung biopsy, before the needle goes in.

`values` holds what is reported, `reporting.LungPaths` makes it of a tissue field.
"""

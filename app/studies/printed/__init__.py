"""WRONG ON PURPOSE: formulas as the thesis prints them and as the laboratory's code has them.

Nothing but the studies may import this folder. Each function says what is wrong with it and names
its entry in docs/errata.md; what the program uses stands in app/mechanisms. Written from the
description of each mistake, not copied from the code that has it.
"""

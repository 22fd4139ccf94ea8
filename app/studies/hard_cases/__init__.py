"""The register of hard cases: a file for each group of subsystems, which defines `CASES`.

Adding a case is one entry there; a file that is added is in the register (see `studies.hard`).
What a case is, and what it must have, says `case`.
"""

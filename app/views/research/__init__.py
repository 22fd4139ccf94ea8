"""Research studies in the window: who is due for a visit, and questionnaires that are answered."""

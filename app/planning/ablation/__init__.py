"""Ablation: zones of a generator's table, what they cover of a lesion, and the margin about it."""

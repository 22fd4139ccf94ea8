"""Effects, one file each. See 'How to add an effect' in docs/architecture.md.

Nothing here imports them: the registry reads their declarations as text and imports only what a
plan keeps.
"""

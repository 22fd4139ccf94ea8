"""The attempt: state machine, recorder, records read back, store."""

"""The attempt: state machine, recorder, replay and store."""

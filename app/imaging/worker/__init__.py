"""The worker process: what is parsed and decoded of a foreign file is parsed and decoded there.

A file can be made to crash, hang or fill the memory of whatever reads it. Here that is a child
process with a limit of memory and a watchdog over it; the program goes on with the next file.
`pool` is the program's side, `child` (`python -m app.imaging.worker`) the other one.
"""

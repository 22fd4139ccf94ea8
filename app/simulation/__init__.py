"""The simulated world: scene compiler, effects, the simulated robot and hand, the scripted trainee.

Never imports `device`: both meet on the slots of `core.state_vector`.
"""

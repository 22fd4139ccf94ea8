"""A hand at the handle of a long tool: bounded turns wherever the handle is."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.planning.placement import PatientOrientation
from app.session.pad.geometry import path_frame
from app.session.pad.hand import LEAST_OUTSIDE, LONGEST_TURN, Handle


@given(
    st.floats(-0.03, 0.5),
    st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)),
    st.floats(-3.14, 3.14),
    st.floats(0.0, 1.5),
)
@settings(derandomize=True, deadline=None, max_examples=200)
def test_a_handle_turns_its_tool_by_a_bounded_angle_that_goes_with_its_way(depth, way, turn, lean):
    tool = Handle(0.3)
    frame = path_frame((0.0, 0.0, -1.0), PatientOrientation.SUPINE.rotation)
    axis = np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), -np.cos(lean)])
    after = tool.turned(frame, axis, way, depth)
    angle = float(angle_between(after, axis))
    assert abs(np.linalg.norm(after) - 1.0) < 1e-14
    assert abs(angle - min(np.hypot(*way) / tool.outside(depth), LONGEST_TURN)) < 1e-12
    assert abs(tool.scale(depth)) <= max(abs(depth), 0.0) / LEAST_OUTSIDE

"""What is said of the needle where two cameras do not look at its marker."""

from math import inf

import pytest
from views_exercise_fakes import placed_plan, pose, snapshot, statistics

from app.core.messages import sentence
from app.session.needle import DepthSource
from app.session.snapshot import NextStep, StepKind
from app.tracking.fix import FixStatus
from app.views.exercise.readings import status_items, tracker_figures, tracker_status
from app.views.exercise.steps import step_words
from app.views.exercise.tracker_panel import TrackerPanel
from app.views.kit.verdict import Verdict

INVERSE3 = {"told_by": "Haply Inverse3"}
PEN = {"looks_for": "pen"}


def strip(**changes):
    """The line of the strip, as a student reads it."""
    item = tracker_status(snapshot(tracker=statistics(**changes))).for_student()
    return f"{item.title}: {item.text}"


def test_the_strip_says_what_tells_the_needle():
    assert strip() == "Cameras: see the marker"
    assert strip(**INVERSE3) == "Needle: told by Haply Inverse3"
    assert strip(valid_share=0.3, **INVERSE3) == "Needle: told by Haply Inverse3 now and then"
    assert strip(age=inf, **INVERSE3) == "Needle: not told by Haply Inverse3"
    assert strip(**PEN) == "Webcam: sees the pen"
    assert strip(age=inf, **PEN) == "Webcam: does not see the pen"


@pytest.mark.parametrize("source", [INVERSE3, PEN])
def test_a_source_s_own_reason_stands_in_place_of_one_about_cameras(source):
    reason = sentence("the hub is where no needle can be: lift it over the entry")
    assert strip(status=FixStatus.OUT_OF_VIEW, reason=reason, **source).endswith(reason)


def test_nothing_of_the_strip_names_cameras_or_a_marker_where_there_are_none():
    shot = snapshot(tracker=statistics(**INVERSE3))
    for item in status_items(shot, 1000.0, 0.0, 0.01):
        assert "camera" not in f"{item.title} {item.text} {item.plain}".lower()
        assert "marker" not in f"{item.text} {item.plain} {item.help}".lower()
        assert item.verdict in (Verdict.GOOD, Verdict.IDLE)
    depth = status_items(shot, 1000.0, 0.0, 0.01)[3]
    assert depth.text == "from Haply Inverse3"
    assert "told by Haply Inverse3" in depth.help
    seen = snapshot(tracker=statistics(**PEN))
    assert status_items(seen, 1000.0, 0.0, 0.01)[3].text == "from the webcam"
    held = pose(placed_plan(), depth_source=DepthSource.HELD)
    assert status_items(snapshot(pose=held), 1000.0, 0.0, 0.01)[3].plain == "measured a moment ago"


def test_no_step_asks_cameras_to_see_what_none_looks_at():
    for kind in (StepKind.SEE, StepKind.FEEL):
        assert "cameras" in step_words(NextStep(kind), by_mouse=False)
        assert "camera" not in step_words(NextStep(kind), False, told_by="Haply Inverse3")


def test_in_place_of_pictures_it_is_said_who_tells_the_needle(qt):
    panel = TrackerPanel()
    panel.show_tracker(None, tracker_figures(snapshot(tracker=statistics(**INVERSE3))), 1.0)
    words = "No camera looks at the needle: Haply Inverse3 tells it"
    assert panel.cameras[0]._instead == words
    panel.show_tracker(None, tracker_figures(snapshot()), 2.0)
    assert panel.cameras[0]._instead == ""

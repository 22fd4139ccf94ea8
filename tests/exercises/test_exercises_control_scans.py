"""Control scans as an exercise asks for them; what it does not ask for is as it was."""

import numpy as np
import pytest

from app.core.configuration import parse
from app.core.errors import AcusError
from app.exercises.guidance import GuidancePart, ScanChoice
from app.exercises.library import library
from app.imaging.scan_look import BreathPicture, NeedleEnds, ScanLook
from app.imaging.scan_order import ScanOrder

AS_EVER = {"mode", "slices", "slice_mm", "streak", "dose_per_slice"}


def test_what_is_younger_is_off_and_leaves_no_trace_in_documents() -> None:
    assert set(GuidancePart().model_dump(mode="json")) == AS_EVER
    for exercise in library().exercises:
        asks = exercise.guidance.model_dump(mode="json")
        if exercise.guidance.tube_current or exercise.guidance.leave_room_s is not None:
            continue  # one that asks for it
        assert set(asks) == AS_EVER, exercise.id
        assert exercise.guidance.look(ScanChoice(), (0.0, 0.0, 0.0), 1) == ScanLook(
            exercise.guidance.streak
        )


def test_what_is_asked_for_is_written_and_read_back() -> None:
    part = GuidancePart(tube_current=(20.0, 50.0), leave_room_s=20.0, interval_mm=7.0,
                        needle_ends="drawn", breath="layers", gantry_tilt=True)  # fmt: skip
    document = part.model_dump(mode="json")
    assert document["tube_current"] == [20.0, 50.0]
    assert GuidancePart.model_validate(document) == part
    assert (part.needle_ends, part.breath) == (NeedleEnds.DRAWN, BreathPicture.LAYERS)


@pytest.mark.parametrize(
    ("values", "words"),
    [({"interval_mm": 4.0}, "gap of -1 mm"), ({"interval_mm": -5.0}, "gap of -10 mm"),
     ({"tube_current": [0.0]}, "greater than 0"), ({"tube_current": [20.0, 20.0]}, "twice"),
     ({"leave_room_s": 0.0}, "greater than 0"), ({"needle_ends": "round"}, "drawn"),
     ({"breath": "some"}, "layers")],
)  # fmt: skip
def test_bad_values_are_refused_in_one_line(values: dict[str, object], words: str) -> None:
    with pytest.raises(AcusError, match=words) as refused:
        parse(values, GuidancePart, "guidance")
    assert "\n" not in str(refused.value).strip()


def test_noise_goes_as_one_over_the_root_of_the_current_and_dose_as_the_current() -> None:
    part = GuidancePart(tube_current=(10.0, 20.0, 50.0, 100.0, 150.0, 300.0))
    own = part.planning_noise_hu
    order = ScanOrder(0.0, 3, 5.0)
    for current in part.tube_current[:-1]:
        choice = ScanChoice(current)
        together = np.hypot(own, part.noise(choice))
        assert together == pytest.approx(own * np.sqrt(150.0 / current))
        assert part.dose(order, choice) / part.dose(order) == pytest.approx(current / 150.0)
    assert part.noise(ScanChoice(300.0)) == 0.0  # nothing is taken away
    assert part.noise(ScanChoice()) == 0.0


def test_thinner_slices_are_noisier() -> None:
    thick, thin = (GuidancePart(slice_mm=mm, tube_current=(20.0,)) for mm in (5.0, 1.25))
    choice = ScanChoice(20.0)
    assert thin.noise(choice) == pytest.approx(2.0 * thick.noise(choice))


def test_the_hand_has_a_dose_only_where_somebody_asks_and_stays() -> None:
    assert GuidancePart().hand_dose(ScanChoice()) is None
    part = GuidancePart(leave_room_s=20.0)
    assert part.hand_dose(ScanChoice(leaves=True)) == 0.0
    assert part.hand_dose(ScanChoice()) == pytest.approx(0.101 * 150.0 * 0.5, rel=0.01)
    assert part.choice == ScanChoice(None, leaves=True)

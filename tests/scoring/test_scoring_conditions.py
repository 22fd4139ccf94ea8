"""What a score was made under: it survives being written, and alone decides what is comparable."""

from dataclasses import fields, replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.scoring.conditions import Assistance, Conditions, DeviceKind, comparable

BASE = Conditions(
    exercise="first-insertion", version=1, level=1, content="abc",
    assistance=Assistance(0.7, 0.7, 0.7, 0.7), views=("bullseye", "live_overlay"), hand="mouse",
    kind=DeviceKind.SIMULATED, device="icube", ct="ct-1", seed=3, software="1.0", scoring_version=2,
)  # fmt: skip


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"exercise": "thick-tissue"}, "exercise"),
        ({"version": 2}, "version"),
        ({"level": 3}, "level"),
        ({"content": "other"}, "under the same version"),
        ({"assistance": Assistance(0.7, -0.5, 0.7, 0.1)}, "assistance"),
        ({"assistance": None}, "assistance"),
        ({"views": ("bullseye",)}, "views"),
        ({"hand": "script", "scripted": "expert"}, "hand"),
        ({"kind": DeviceKind.REAL}, "simulated and real"),
        ({"kind": DeviceKind.EMULATED}, "simulated and emulated"),
        ({"kind": DeviceKind.UNKNOWN}, "not known"),
        ({"device": "haply-2diy"}, "device"),
        ({"ct": "ct-2"}, "CT"),
        ({"scoring_version": 1}, "scored by version"),
        ({"scoring_version": 0}, "no score"),
    ],
)
def test_scores_made_under_something_else_are_not_comparable(
    change: dict[str, object], word: str
) -> None:
    other = replace(BASE, **change)  # type: ignore[arg-type]
    reasons = comparable(BASE, other)
    assert any(word in reason for reason in reasons), reasons
    assert len(comparable(other, BASE)) == len(reasons)


@pytest.mark.parametrize(
    "change",
    [
        {"seed": 4},
        {"software": "1.1"},
        {"calibration": "20260101-aa"},
        {"agreement_mm": 1.2},
        {"assistance": Assistance(None, 0.69, 0.71, 0.7)},
    ],
)
def test_noise_version_and_a_touched_dial_part_no_scores(change: dict[str, object]) -> None:
    assert comparable(BASE, replace(BASE, **change)) == ()  # type: ignore[arg-type]


@settings(derandomize=True, deadline=None)
@given(
    dial=st.none() | st.builds(Assistance, st.none() | st.floats(-1, 1), *([st.floats(-1, 1)] * 3)),
    kind=st.sampled_from(DeviceKind),
    views=st.none() | st.lists(st.text(max_size=8), max_size=3).map(tuple),
    seed=st.none() | st.integers(),
    text=st.text(max_size=20),
)
def test_conditions_survive_being_written_and_read(
    dial: Assistance | None, kind: DeviceKind, views: tuple[str, ...] | None, seed: int | None,
    text: str,
) -> None:  # fmt: skip
    there = replace(
        BASE, assistance=dial, kind=kind, views=views, seed=seed, device=text, exercise=text
    )
    assert Conditions.of(there.document()) == there
    assert comparable(there, there) == () or kind is DeviceKind.UNKNOWN


def test_a_newer_version_may_say_more_and_an_older_one_less() -> None:
    more = BASE.document() | {"needle": "18 G"}
    assert Conditions.of(more) == BASE
    for field in fields(Conditions):
        if field.name != "exercise":
            less = {name: value for name, value in BASE.document().items() if name != field.name}
            assert Conditions.of(less).exercise == BASE.exercise


@pytest.mark.parametrize("value", [float("nan"), float("inf"), "much"])
def test_a_dial_that_is_no_number_is_refused(value: object) -> None:
    document = BASE.document()
    document["assistance"] = {"start": 0.0, "least": value, "most": 0.0, "mean": 0.0}
    with pytest.raises(ValueError, match=r"number|float"):
        Conditions.of(document)

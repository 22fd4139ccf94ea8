"""The CT of an attempt in its record: which one, and what was done to its files."""

import pytest

from app.imaging.series import AS_IT_IS, Recipe
from app.session.ct_facts import CtFacts

MENDED = CtFacts(
    "CT-1", ("straightened from a gantry tilt of 14.0°",), Recipe("straighten", spacing_mm=4.9)
)


@pytest.mark.parametrize(
    "facts",
    [
        MENDED,
        CtFacts("CT-2", ("reduced",), Recipe("halve", (2, 2, 1))),
        CtFacts("CT-3", (), AS_IT_IS),
        CtFacts(),
    ],
)
def test_a_record_gives_the_facts_back(facts: CtFacts) -> None:
    record = facts.metadata()
    assert all(isinstance(value, str) for value in record.values())
    assert CtFacts.of_metadata(record) == facts


@pytest.mark.parametrize(
    "change",
    [{"remedy": "paint"}, {"factors": "[2, 2]"}, {"factors": "7"}, {"factors": "[0, 1, 1]"},
     {"spacing_mm": "wide"}, {"made": "{"}, {"made": "5"}],
)  # fmt: skip
def test_a_damaged_record_tells_what_it_can(change: dict[str, str]) -> None:
    read = CtFacts.of_metadata(MENDED.metadata() | change)
    assert read.pseudonym == "CT-1"
    assert read.recipe is None or "made" in change


def test_a_record_that_does_not_say_it_does_not_know_how_the_ct_was_read() -> None:
    read = CtFacts.of_metadata({"pseudonym": "CT-0A7961D5"})
    assert read == CtFacts("CT-0A7961D5")
    assert read.document()["remedy"] is None

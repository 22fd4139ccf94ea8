"""Names and dates of a PACS in people's own words."""

from datetime import date

import pytest

from app.core.errors import ConfigurationError
from app.imaging.pacs.query import FoundSeries, FoundStudy
from app.views.kit.text import day
from app.views.pacs.panel import PacsPanel, dates_asked, name_asked, name_words

# DICOM PS3.5, section 6.2.1.2: examples of person names.
NAMES = {
    "Adams^John Robert Quincy^^Rev.^B.A. M.Div.": "Adams, John Robert Quincy, Rev., B.A. M.Div.",
    "Morrison-Jones^Susan^^^Ph.D., Chief Executive Officer":
        "Morrison-Jones, Susan, Ph.D., Chief Executive Officer",
    "Doe^John": "Doe, John",
    "Yamada^Tarou=山田^太郎=やまだ^たろう": "Yamada, Tarou",
    "SMITH": "SMITH",
    "": "",
}  # fmt: skip


@pytest.mark.parametrize("stored", NAMES)
def test_a_name_is_written_as_people_write_it(stored):
    assert name_words(stored) == NAMES[stored]


@pytest.mark.parametrize(
    ("written", "asked"),
    [
        ("Doe, John", "Doe^John"),
        (" doe*,j? ", "doe*^j?"),
        ("Doe, John Q", "Doe^John^Q"),
        ("Doe", "Doe"),
        ("DOE^JOHN", "DOE^JOHN"),
        ("", ""),
    ],
)
def test_a_name_is_asked_for_as_the_pacs_has_it(written, asked):
    assert name_asked(written) == asked


# The first of February, written in the ways of ISO 8601, of German, of French and of DICOM.
WAYS = ["2024-02-01", "1.2.2024", "01.02.2024", "01/02/2024", "20240201"]


@pytest.mark.parametrize("written", WAYS)
@pytest.mark.parametrize("dash", ["-", " - ", " \u2013 "])
def test_dates_may_be_written_in_every_usual_way(written, dash):
    assert dates_asked(f" {written} ") == "20240201"
    assert dates_asked(written + dash + "2024-03-01") == "20240201-20240301"
    assert dates_asked(written + dash) == "20240201-"
    assert dates_asked(dash + written) == "-20240201"


def test_the_languages_own_way_to_write_a_date_is_understood():
    assert dates_asked(day(date(2024, 2, 1))) == "20240201"
    assert dates_asked("") == ""


@pytest.mark.parametrize("written", ["yesterday", "2024", "2024-13-01", "31.2.2024", "20241301"])
def test_what_is_no_date_is_said_with_an_example(written):
    with pytest.raises(ConfigurationError, match="2024-02-01"):
        dates_asked(written)


def test_the_panel_lists_names_and_dates_as_people_write_them(application, destroy):
    panel = PacsPanel()
    destroy(panel)
    study = FoundStudy("1.2", "20240201", "Doe^Jane^Q", "ID", "19700101", "Chest", ("CT",), 5)
    panel.show_found([(FoundSeries("1.2.3", study, "2", "CT", "Lung", "CHEST", 5), 0)])
    row = panel.tree.topLevelItem(0)
    assert row.text(0) == "Doe, Jane Q"
    assert row.text(2) == day(date(2024, 2, 1)) == "2024-02-01"
    assert "^" not in panel.name.placeholderText()
    assert "YYYY" not in panel.date.placeholderText()

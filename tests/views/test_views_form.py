"""The one form of the window: what a row takes from the field of a model, values in and out."""

from pathlib import Path
from typing import Annotated

import pytest
from pydantic import Field
from PySide6.QtCore import QLocale
from PySide6.QtWidgets import QLabel

import app
from app.core.configuration import FieldText, Strict, checked
from app.views.kit.form import Form


class Inner(Strict):
    """A part of what is edited."""

    wait_s: Annotated[float, Field(ge=0.0, le=9.0), FieldText("Wait")] = 2.5


class Model(Strict):
    """What is edited."""

    host: Annotated[str, Field(min_length=1), FieldText("Host", "name or address")]
    port: Annotated[int, Field(ge=1, le=65535), FieldText("Port")] = 104
    share: Annotated[float, Field(gt=0.0, le=50.0), FieldText("Share", unit="%")] = 20.0
    inner: Inner = Inner()
    far_mm: Annotated[float | None, FieldText("Distance")] = None
    some: Annotated[tuple[str, ...], FieldText("Some of them")] = ()
    on: Annotated[bool, FieldText("Switched on")] = True
    kind: Annotated[str, FieldText("Kind")] = "a"


@pytest.fixture
def form(application):
    made = Form(Model, title="Things")
    made.line = made.text("host")
    made.port = made.count("port")
    made.share = made.number("share")
    made.wait = made.number("inner", "wait_s", decimals=1)
    made.far = made.number("far_mm", within=(0.0, 400.0, 0.0), lowest="usual")
    made.boxes = made.flags("some", among=(("x", "An x"), ("y", "A y")))
    made.on = made.check("on")
    made.kind = made.choice("kind", among=(("a", "First"), ("b", "Second")))
    yield made
    made.deleteLater()


def test_title_range_unit_and_help_are_those_of_the_field(form):
    assert form.names["host",].text() == "Host"
    assert form.names["host",].buddy() is form.line
    assert form.line.accessibleName() == "Host"
    assert form.line.placeholderText() == form.line.toolTip() == "name or address"
    assert (form.port.minimum(), form.port.maximum(), form.port.value()) == (1, 65535, 104)
    assert (form.share.minimum(), form.share.maximum()) == (0.01, 50.0)
    assert (form.share.suffix(), form.wait.suffix(), form.far.suffix()) == (" %", " s", " mm")
    assert form.on.text() == "Switched on"
    assert form.names["inner", "wait_s"].text() == "Wait"


def test_what_is_shown_is_read_again_and_a_field_left_out_has_its_default(form):
    given = {
        "host": "house",
        "port": 11112,
        "share": 12.5,
        "inner": {"wait_s": 4.0},
        "far_mm": 30.0,
        "some": ["y"],
        "on": False,
        "kind": "b",
    }
    form.show_values(given)
    assert form.values() == given
    form.show_values({"host": "other"})
    left = {"host": "other", "port": 104, "share": 20.0, "inner": {"wait_s": 2.5}, "some": []}
    assert form.values() == {**left, "on": True, "kind": "a"}  # the smallest distance is none
    assert form.far.text() == "usual"


def test_only_what_a_hand_does_is_told(form):
    told = []
    form.edited.connect(lambda where, value, typed: told.append((where, value, typed)))
    form.show_values({"host": "house", "port": 7, "kind": "b", "on": False, "some": ["x"]})
    assert told == []
    form.port.setValue(8)
    form.line.textEdited.emit("houses")
    form.boxes["y"].click()
    assert told == [
        (("port",), 8, False),
        (("host",), "houses", True),
        (("some",), ["x", "y"], False),
    ]


def test_what_cannot_be_chosen_now_keeps_what_was_said_of_it(form):
    form.show_values({"some": ["x"]})
    form.boxes["x"].setEnabled(False)
    form.boxes["x"].setChecked(False)
    assert form.values()["some"] == ["x"]


def test_a_value_that_is_not_among_a_choice_joins_it(form):
    form.show_values({"kind": "of one's own"})
    assert (form.kind.currentData(), form.kind.count()) == ("of one's own", 3)


def test_numbers_are_written_as_the_language_writes_them(form):
    form.setLocale(QLocale("de_DE"))
    form.show_values({"inner": {"wait_s": 4.5}})
    assert form.wait.text() == "4,5 s"


def test_a_page_says_below_each_field_what_is_wrong_with_it(application):
    page = Form(Model, title="Things", page=True)
    page.text("host")
    page.number("inner", "wait_s")
    _, problems = checked({"host": "", "inner": {"wait_s": 12.0}}, Model)
    page.tell(problems)
    words = [one.text() for one in page.findChildren(QLabel) if one.text().startswith("✖")]
    assert words == ["✖ is empty: type something", "✖ 12.0 is too large: at most 9"]
    assert [page.name_of(one) for one in problems] == ["Host", "Wait"]
    page.tell(())
    assert not [one for one in page.findChildren(QLabel) if one.text().startswith("✖")]
    page.deleteLater()


def test_several_fields_in_a_row_have_its_name(application):
    form = Form()
    with form.together(title="&Squares") as line:
        columns = form.count("columns", within=(3, 60, 9))
        line.addWidget(QLabel("×"))
        rows = form.count("rows", within=(3, 60, 6))
    assert form.names["columns",] is form.names["rows",]
    assert form.names["rows",].buddy() is columns
    assert [one.accessibleName() for one in (columns, rows)] == ["Squares", "Squares"]
    assert form.values() == {"columns": 9, "rows": 6}
    form.deleteLater()


def test_forms_are_made_in_one_place():
    views = Path(app.__file__).parent / "views"
    found = {
        str(path.relative_to(views))
        for path in views.rglob("*.py")
        if "QFormLayout" in path.read_text(encoding="utf-8")
    }
    # The panel of an attempt is no form: its rows are live controls that come and go.
    assert found == {"kit/form.py", "exercise/panel.py"}

"""Literal declarations of plug-in files, read without importing them."""

from dataclasses import dataclass

import pytest

from app.core.errors import AcusError
from app.core.plugins import TEXT, Declaration, Field, PluginKind, number_within


class GadgetError(AcusError):
    pass


@dataclass(frozen=True, kw_only=True)
class Gadget(Declaration):
    size: tuple[int, float]


KIND = PluginKind("a gadget", Gadget, {"title": TEXT, "size": Field("a size", tuple)}, GadgetError)


def read(folder, text):
    path = folder / "gadget.py"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return KIND.read(path)


@pytest.mark.parametrize("annotation", ["", ": Final[dict[str, Any]]"])
def test_a_declaration_is_read_and_the_file_is_not_run(tmp_path, annotation):
    head = "raise SystemExit\nother, DECLARED = 1, 2\n"
    found = read(tmp_path, f"{head}DECLARATION{annotation} = {{'title': 'A', 'size': (1, 2.5)}}")
    assert (found.name, found.title, found.size) == ("gadget", "A", (1, 2.5))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("x = 1", "has no DECLARATION = {...}; see 'How to add a gadget'"),
        ("DECLARATION = [1]", "has no DECLARATION"),
        ("DECLARATION: dict", "has no DECLARATION"),
        ("DECLARATION = {'title': open('x')}", "not a literal"),
        ("DECLARATION = {[]: 1}", "not a literal"),
        ("DECLARATION = {'title': 'A'}", r"exactly the keys title, size; check \['size'\]"),
        ("DECLARATION = {'title': 'A', 'size': 1, 'x': 2}", r"check \['x'\]"),
        ("DECLARATION = {'title': 'A',\n 'size': 1}", "line 2: size is 1; give a size"),
        ("DECLARATION = {'title': '', 'size': ()}", "line 1: title is ''; give a text that is"),
        ("def", "gadget file .* cannot be read"),
        (b"\xff\xfe", "gadget file .* cannot be read"),
    ],
)
def test_a_declaration_that_cannot_be_used_is_named_in_the_rooms_own_error(tmp_path, text, words):
    with pytest.raises(GadgetError, match=words) as caught:
        read(tmp_path, text)
    assert "gadget.py" in str(caught.value)


@pytest.mark.parametrize("bad", [True, "1", None, float("nan"), float("inf"), -0.1, 2.1, 10**400])
def test_what_is_no_finite_number_in_its_range_is_none(bad):
    assert number_within(bad, 0.0, 2.0) is None
    assert number_within(2, 0.0, 2.0) == 2.0

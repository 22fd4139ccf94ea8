"""Words that a stranger stumbles over grow no more."""

import ast
from collections import Counter

from tools.words import count, fields_in, lowered, risen, unmarked_in, words_in


def test_no_refused_word_is_there_more_often_than_before():
    """`python -m tools.words --list` names each; docs/vocabulary.md says which to use."""
    counts, _ = count()
    assert risen(counts) == []


def test_names_at_borders_docstrings_without_a_verb_and_texts_are_seen():
    tree = ast.parse(
        "class Row:\n"
        "    why: str\n"
        "def take(found, *, told=1):\n"
        '    """Whether it is taken."""\n'
        "    one = 1\n"
        "    self._kept = one\n"
        '    tr("It counts for nobody.")\n'
    )
    words = sorted(word for word, _ in words_in(tree))
    assert words == [
        "docstring: Whether",
        "name: found",
        "name: kept",
        "name: told",
        "name: why",
        "text: counts for nobody",
    ]


def test_what_is_written_is_never_more_than_before():
    counts = Counter({"name: one": 5, "name: told": 2, "name: why": 1})
    before = {"name: one": 3, "name: told": 4, "text: anew": 2}
    assert lowered(counts, before) == {"name: one": 3, "name: told": 2}


def test_a_raise_below_the_window_that_nobody_can_translate_is_seen():
    wrong = (
        'raise DeviceError(f"{path} is busy")',
        'raise DeviceError("the port is busy")',
        'raise DeviceError("%s is busy" % path)',
        'raise DeviceError("{} is busy".format(path))',
        'raise DeviceError("busy: " + path if busy else f"{path} is gone")',
        'raise CarryError(MISSED, f"{path} is busy")',
    )
    right = (
        'raise DeviceError(sentence("{path} is busy", path=path))',
        "raise DeviceError(message)",
        'raise AttributeError(f"no attribute {name}")',
        'raise self.wrong(f"{key}.data", value)',
        "raise",
    )
    assert [list(unmarked_in(ast.parse(code))) for code in wrong] == [[1]] * len(wrong)
    assert [list(unmarked_in(ast.parse(code))) for code in right] == [[]] * len(right)


def test_a_field_that_no_translator_understands_is_seen():
    wrong = {
        'sentence("{text} is no number", text=text)': "text",
        'sentence("{path}: {value!r} is not finite", path=path, value=x)': "value",
        'sentence("{not_}", not_=why)': "not_",
        'sentence("{mm} mm, within {mm_2:.1f} mm", mm=a, mm_2=b)': "_2",
        'sentence("{a} of {a_13}", a=a, a_13=b)': "_2",
        'sentence("{missing_first!r} is missing", missing_first=missing[0])': "_first",
        'sentence("{rays_count} rays of {rays_count}", rays_count=len(rays))': "_count",
    }
    for code, word in wrong.items():
        assert list(fields_in(ast.parse(code))) == [(f"field: {word}", 1)], code
    right = (
        'sentence("entry {entry} and target {target}", entry=a, target=b)',
        'sentence("{{text}} {first} {account} {value_mm} {context}", **values)',
        'tr("{text} is no number", text=text)',
        'sentence("nothing is there")',
    )
    assert [list(fields_in(ast.parse(code))) for code in right] == [[]] * len(right)

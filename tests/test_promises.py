"""What README and docs promise of safety, privacy and records has a test that is marked with it."""

import ast
from pathlib import Path

import pytest

from tools.promises import NOT_PROMISED, PAGE, ROOT, promises, unheld, words, written


def test_the_table_of_promises_is_what_the_tests_are_marked_with():
    found = promises()
    assert 40 <= len(found) <= 80
    assert PAGE.read_text(encoding="utf-8") == written(found), "write it: make promises"


def test_every_promise_stands_in_its_page_as_it_is_marked():
    known = {page: words(page) for page in {one.page for one in promises()}}
    assert [one for one in promises() if one.sentence not in known[one.page]] == []
    listed = (key.split(": ", 1) for key in NOT_PROMISED)
    assert [key for key in listed if key[1] not in words(key[0])] == []


def test_every_never_and_always_of_safety_and_privacy_is_held_or_listed():
    assert unheld(promises()) == []


def test_a_never_that_nobody_holds_is_found(monkeypatch, tmp_path):
    (tmp_path / "README.md").write_text("It is red. Acus *never* sleeps, as\nall know.\n")
    monkeypatch.setattr("tools.promises.ROOT", tmp_path)
    monkeypatch.setattr("tools.promises.WATCHED", ("README.md",))
    assert unheld([]) == ["README.md: Acus *never* sleeps, as all know."]


@pytest.mark.parametrize("mark", ["'no page'", "1", "'a.md'"])
def test_a_mark_without_page_and_sentence_is_refused(tmp_path, mark):
    (tmp_path / "test_a.py").write_text(
        f"import pytest\n@pytest.mark.promise({mark})\ndef test_a(): ...\n"
    )
    with pytest.raises(ValueError, match=r"test_a.py::test_a is marked with"):
        promises(tmp_path)


@pytest.mark.long("journey")
def test_what_holds_a_promise_is_run_by_the_tests_and_asserts_something():
    for one in promises():
        file, _, name = one.test.partition("::")
        tree = ast.parse(Path(ROOT / file).read_text(encoding="utf-8"))
        (test,) = (n for n in ast.walk(tree) if isinstance(n, ast.FunctionDef) and n.name == name)
        asserts = any(isinstance(node, ast.Assert | ast.With) for node in ast.walk(test))
        assert asserts or "pytest.fail" in ast.unparse(test), one.test
        assert not any(".skip(" in ast.unparse(mark) for mark in test.decorator_list), one.test

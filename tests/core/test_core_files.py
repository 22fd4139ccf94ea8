import os

import pytest

from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.files import write_atomically


class Probe(Strict):
    rate_hz: float
    name: str = "probe"


class Pair(Strict):
    first: Probe
    second: Probe
    sizes: tuple[int, ...] = ()


def written(tmp_path, text):
    path = tmp_path / "probe.yaml"
    path.write_text(text)
    return path


def test_a_good_file_is_read(tmp_path):
    assert load(written(tmp_path, "rate_hz: 1000\n"), Probe) == Probe(rate_hz=1000)


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("rate_hz: fast\n", ["rate_hz", "'fast'", "number"]),
        ("rate_hz: .nan\n", ["rate_hz", "finite"]),
        ("rate_hz: 1\nrat: 2\n", ["rat", "not permitted"]),
        ("rate_hz: 1\nrate_hz: 2\n", ["twice", "line 2"]),
        ("rate_hz: [1\n", ["not valid YAML"]),
        ("", ["(document)"]),
        ("name: x\n", ["rate_hz", "required"]),
        ("!!python/object/apply:os.system [ls]\n", ["not valid YAML"]),
        ("rate_hz: true\n", ["rate_hz", "number", "True"]),
        ("rate_hz: yes\n", ["rate_hz", "number"]),
        ("rate_hz: 2026-99-99\n", ["not valid YAML", "month"]),
        ("rate_hz: !!int abc\n", ["not valid YAML", "abc"]),
        ("rate_hz: !!bool x\n", ["not valid YAML"]),
        ("rate_hz: " + "9" * 5000 + "\n", ["not valid YAML", "digits"]),
        ("? [1, 2]\n: 3\n", ["not valid YAML", "a key must be a name", "line 1"]),
        ("? {a: 1}\n: 3\n", ["not valid YAML", "a key must be a name"]),
        ("name: " + "[" * 3000 + "]" * 3000 + "\n", ["nested too deeply"]),
    ],
)
def test_a_bad_file_is_refused_naming_file_field_and_value(tmp_path, text, parts):
    with pytest.raises(ConfigurationError) as caught:
        load(written(tmp_path, text), Probe)
    message = str(caught.value)
    for part in ["probe.yaml", *parts]:
        assert part.lower() in message.lower()
    assert "\n" not in message


def test_every_field_that_is_wrong_is_named_at_once_and_nothing_is_dumped(tmp_path):
    with pytest.raises(ConfigurationError) as caught:
        load(written(tmp_path, "first: {name: x, rate: 3}\nsizes: {a: 1}\nthird: [4, 5]\n"), Pair)
    message = str(caught.value).partition("probe.yaml: ")[2]
    assert message == (
        "required and missing: first.rate_hz, second; "
        "first.rate: Extra inputs are not permitted, got 3; valid names: rate_hz, name (line 1); "
        "sizes: Input should be a valid tuple, got a mapping of 1 (line 2); "
        "third: Extra inputs are not permitted, got a list of 2; "
        "valid names: first, second, sizes (line 3)"
    )


def test_thousands_of_wrong_values_are_named_by_the_first_of_them(tmp_path):
    text = f"first: {{rate_hz: 1}}\nsecond: {{rate_hz: 1}}\nsizes: [{'x, ' * 3000}]\n"
    with pytest.raises(ConfigurationError, match="and 2988 more like these"):
        load(written(tmp_path, text), Pair)


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ConfigurationError, match=r"nothing\.yaml"):
        load(tmp_path / "nothing.yaml", Probe)


def test_a_failed_write_leaves_the_old_file_and_no_rubbish(tmp_path, monkeypatch):
    path = tmp_path / "plan.json"
    write_atomically(path, "old")
    monkeypatch.setattr("os.fsync", _no_space)
    with pytest.raises(OSError, match="no space"):
        write_atomically(path, "new")
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["plan.json"]


def _no_space(_):
    raise OSError("no space left")


def test_a_written_file_has_the_permissions_that_the_user_wants(tmp_path):
    old = os.umask(0o022)
    try:
        write_atomically(tmp_path / "report.pdf", b"%PDF")
    finally:
        os.umask(old)
    assert (tmp_path / "report.pdf").stat().st_mode & 0o777 == 0o644

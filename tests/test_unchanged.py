"""What compares two descriptions of the program finds each kind of difference, and nothing else."""

from pathlib import Path

import pytest

from tools.unchanged import DIFFERENT, main

FILES = {"help.txt": "acus\n    run\n    demo\n", "records/one.csv": "time_s,note\r\n0,\r\n"}


def described(folder: Path, files: dict[str, str] = FILES) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text.encode())
    return folder


@pytest.fixture
def before(tmp_path: Path) -> Path:
    return described(tmp_path / "before")


def compared(before: Path, after: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    code = main(["compare", str(before), str(after)])
    return code, capsys.readouterr().out


def test_two_equal_descriptions_are_equal(before, tmp_path, capsys):
    code, words = compared(before, described(tmp_path / "after"), capsys)
    assert (code, words) == (0, "equal: 2 files\n")


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"help.txt": "acus\n    run\n    show\n"}, ("≠ help.txt", "-    demo", "+    show")),
        ({"records/one.csv": "time_s,note\n0,\n"}, ("≠ records/one.csv",)),
        ({"wire.txt": "00 05\n"}, ("≠ wire.txt", "additional afterwards")),
    ],
    ids=["changed line", "other line ends", "additional file"],
)
def test_a_difference_is_named_and_ends_with_its_code(before, tmp_path, capsys, change, told):
    code, words = compared(before, described(tmp_path / "after", FILES | change), capsys)
    assert code == DIFFERENT == 3
    assert all(line in words for line in told)
    assert words.count("≠") == 1


def test_a_missing_file_is_named(before, tmp_path, capsys):
    after = described(tmp_path / "after", {"help.txt": FILES["help.txt"]})
    code, words = compared(before, after, capsys)
    assert code == DIFFERENT
    assert words.startswith("≠ records/one.csv\n    missing afterwards\n")


def test_of_a_long_difference_the_first_lines_are_printed(before, tmp_path, capsys):
    long = {"help.txt": "".join(f"{k}\n" for k in range(300))}
    code, words = compared(before, described(tmp_path / "after", FILES | long), capsys)
    assert code == DIFFERENT
    assert len(words.splitlines()) < 20
    assert "more lines" in words


def test_a_folder_that_is_none_is_refused(before, tmp_path, capsys):
    with pytest.raises(SystemExit):
        main(["compare", str(before), str(tmp_path / "nowhere")])
    assert "nowhere is no folder" in capsys.readouterr().err

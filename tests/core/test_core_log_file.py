import ast
import logging
import re
import subprocess
import sys
import threading
from pathlib import Path

import pytest

import app
from app.core import log_file
from app.core.log_file import LogFile

APP = Path(app.__file__).parent
LOGS = re.compile(
    r"(_?log|logging|_?logger|logging\.getLogger\(.*\))"
    r"\.(debug|info|warning|error|exception|critical|log)"
)


@pytest.fixture
def log():
    made = LogFile(lambda: {"DOE^JOHN"})
    made.open()
    yield made
    made.close()


def failing():
    raise ValueError("of DOE^JOHN in /home/doe/ct/1.dcm")


@pytest.mark.promise("docs/user-guide.md: of an error it keeps kind and place, never its text")
def test_the_log_tells_where_it_failed_and_nothing_of_files_or_people(log):
    try:
        failing()
    except ValueError as error:
        logging.getLogger("acus.test").warning(
            "DOE^JOHN in /home/doe/ct/1.dcm is CT-AB12CD34", exc_info=error
        )
    text = log.path.read_text()
    assert "ValueError" in text
    assert "test_core_log_file.py" in text
    assert "failing" in text
    for secret in ("DOE", "doe", "1.dcm", "AB12CD34"):
        assert secret not in text


@pytest.mark.promise("docs/user-guide.md: of an error it keeps kind and place, never its text")
def test_an_error_that_a_message_quotes_is_logged_by_kind_and_place_too(log):
    try:
        failing()
    except ValueError as error:
        logging.getLogger("acus.test").warning("the picture of %s is not kept: %s", "x", error)
    text = log.path.read_text()
    assert "the picture of x is not kept: ValueError" in text
    assert "failing" in text
    assert "doe" not in text.casefold()


@pytest.mark.long("statistics")
def test_no_message_to_the_log_is_put_together_before_the_log_sees_its_parts():
    """What is text already may quote an error, and nobody can tell."""
    calls = [
        (path.relative_to(APP), call)
        for path in sorted(APP.rglob("*.py"))
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(call, ast.Call) and LOGS.fullmatch(ast.unparse(call.func))
    ]
    assert len(calls) >= 5
    assert [f"{path}:{call.lineno}" for path, call in calls if not in_parts(call)] == []


def in_parts(call: ast.Call) -> bool:
    """Whether a message is a plain text, and no part of it is made of an error's."""
    message, *parts = call.args
    made = (ast.JoinedStr, ast.BinOp)
    texts = ("str", "repr", "format", "ascii")
    return isinstance(message, ast.Constant) and not any(
        isinstance(node, made) or (isinstance(node, ast.Name) and node.id in texts)
        for part in parts
        for node in ast.walk(part)
    )


@pytest.mark.long("statistics")
def test_the_log_is_for_its_owner_alone_and_rotates(log, monkeypatch):
    monkeypatch.setattr(log_file, "LONGEST", 300)
    for _ in range(6 * log_file.LARGEST_BYTES // 300):
        logging.getLogger("acus").info("word " * 100)
    files = sorted(log.path.parent.glob("acus.log*"))
    assert len(files) == 1 + log_file.KEPT
    for file in files:
        assert file.stat().st_mode & 0o077 == 0
        assert file.stat().st_size <= log_file.LARGEST_BYTES


@pytest.mark.filterwarnings("ignore::pytest.PytestUnhandledThreadExceptionWarning")
def test_what_nobody_caught_in_a_thread_is_logged_by_its_place(log, capfd):
    thread = threading.Thread(target=failing)
    thread.start()
    thread.join()
    assert "nobody caught in a thread" in log.path.read_text()
    assert "DOE" not in log.path.read_text() + capfd.readouterr().err


def test_a_folder_that_cannot_be_written_keeps_nobody_from_working(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "file"))
    log = LogFile()
    log.open()
    log.close()
    assert log_file.tail() == ""


def test_a_program_that_the_system_ended_leaves_its_stacks_for_the_next_report(tmp_path):
    code = "from app.core.log_file import LogFile; LogFile().open(); import os; os.abort()"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, check=False)
    assert ended.returncode < 0
    assert log_file.crash_text() == ""  # nobody has started since
    log = LogFile()
    log.open()
    log.close()
    assert "Fatal Python error: Aborted" in log_file.crash_text()
    log.open()
    log.close()
    assert "Aborted" in log_file.crash_text()  # until there is another

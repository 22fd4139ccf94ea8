"""`acus law list`."""

import json

from typer.testing import CliRunner

from app.commands import build

RUN = CliRunner()


def test_laws_are_listed_with_those_that_are_refused_and_why(tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("ACUS_LAWS", str(tmp_path))
    done = RUN.invoke(build(), ["law", "list", "--json"])
    names = {row["law"] for row in json.loads(done.stdout)["facts"]["laws"] if not row["refused"]}
    assert done.exit_code == 0
    assert names >= {"fixture", "cone_wall", "impedance"}
    (tmp_path / "mine.py").write_text("x = 1\n", encoding="utf-8")
    done = RUN.invoke(build(), ["law", "list"])
    assert done.exit_code == 3
    assert "✖ mine: refused: " in done.stdout
    assert "mine.py has no DECLARATION" in done.stdout
    assert (tmp_path / "mine.py").is_file()

"""Render the lines of every answer, also where a test asks for JSON: a wrong template fails it."""

import pytest

from app.commands import answer
from app.commands.shown import lines


@pytest.fixture(autouse=True)
def rendered(monkeypatch: pytest.MonkeyPatch) -> None:
    as_json = answer._text

    def text(found: answer.Answer, name: str) -> str:
        list(lines(found.shown, found.facts))
        return as_json(found, name)

    monkeypatch.setattr(answer, "_text", text)

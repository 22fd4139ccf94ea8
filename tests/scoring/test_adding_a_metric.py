"""A metric is added in just the way that docs/extending.md says: one file, nothing else."""

import re
import sys
from pathlib import Path

import pytest
from scoring_attempts import Attempt

from app.scoring import metrics
from app.scoring.score import score
from app.scoring.tolerance import Tolerance

PAGE = Path(__file__).resolve().parents[2] / "docs" / "extending.md"


def from_the_page() -> str:
    section = PAGE.read_text(encoding="utf-8").split("## How to add a metric")[1].split("\n## ")[0]
    block = re.search(r"```python\n(.*?)```", section, re.DOTALL)
    assert block is not None
    return block.group(1)


@pytest.fixture
def added(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    (tmp_path / "deepest_point.py").write_text(from_the_page(), encoding="utf-8")
    monkeypatch.setattr(metrics, "__path__", [*metrics.__path__, str(tmp_path)])
    yield "deepest_point"  # type: ignore[misc]
    sys.modules.pop("app.scoring.metrics.deepest_point", None)


def test_the_metric_of_the_page_is_found_shown_and_scored(added: str) -> None:
    trajectory = Attempt(depth=0.003).trajectory()
    deepest = trajectory.placed.length * 1e3 + 3.0
    row = score(trajectory).row(added)
    assert row.value == pytest.approx(deepest)
    assert row.tolerance is None

    limits = {"expert": deepest - 5.0, "good": deepest, "pass": deepest + 5.0}
    result = score(trajectory, {added: Tolerance.model_validate(limits)})
    assert result.rows[0].name == added
    assert result.total == pytest.approx(80.0)


def test_the_metric_of_the_page_says_why_it_has_no_value(added: str) -> None:
    phase = ["aligning"] * 2251
    row = score(Attempt().trajectory(phase=phase)).row(added)
    assert row.value is None
    assert row.note == "the needle was never inserted"

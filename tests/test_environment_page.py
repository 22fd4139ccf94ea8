"""The page of the environment is one notebook: its blocks are run in their order."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).resolve().parents[1] / "docs" / "environment.md"


@pytest.mark.long("journey")
def test_the_blocks_of_the_environments_page_run_in_their_order():
    text, names = PAGE.read_text(encoding="utf-8"), {}
    for found in re.finditer(r"^```python\n(.*?)^```", text, flags=re.DOTALL | re.MULTILINE):
        block = "\n" * text[: found.start(1)].count("\n") + found[1]
        exec(compile(block, str(PAGE), "exec"), names)
    assert names["curve"].shape == (2, 2)
    names["env"].close()

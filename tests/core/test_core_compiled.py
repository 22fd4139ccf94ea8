"""Where compiled kernels are kept."""

import os
from pathlib import Path

import pytest

from app.core import compiled, paths


def test_a_cache_that_cannot_be_written_is_replaced_by_a_folder_for_this_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setattr(paths, "cache", lambda: tmp_path / "file" / "cache")
    folder = compiled._cache_folder()
    assert folder.is_dir()
    assert os.access(folder, os.W_OK)
    assert tmp_path not in folder.parents


def test_a_cache_that_can_be_written_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(paths, "cache", lambda: tmp_path)
    assert compiled._cache_folder().parent == tmp_path / "kernels"

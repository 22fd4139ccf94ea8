"""Compiling all kernels before the tests: each once, after those that it is compiled from."""

from concurrent.futures import ThreadPoolExecutor
from graphlib import CycleError

import pytest

from app.compose.first_start import rehearse_tracking
from tools import compile_kernels


def test_every_module_is_imported_once_and_after_those_it_imports(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    imported: list[str] = []
    monkeypatch.setattr(compile_kernels, "import_module_of", imported.append)
    modules = {"loop": {"laws", "wire"}, "laws": {"vectors"}, "wire": {"vectors"}, "vectors": set()}
    with ThreadPoolExecutor(2) as threads:
        compile_kernels.compile_all(modules, threads)
    assert sorted(imported) == sorted(modules)
    assert all(
        imported.index(first) < imported.index(name)
        for name, before in modules.items()
        for first in before
    )


def test_a_module_that_cannot_be_imported_ends_it_with_its_own_error() -> None:
    with ThreadPoolExecutor(2) as threads, pytest.raises(ModuleNotFoundError, match="no_such"):
        compile_kernels.compile_all({"app.no_such": set()}, threads)


def test_modules_in_a_circle_are_refused() -> None:
    with ThreadPoolExecutor(2) as threads, pytest.raises(CycleError):
        compile_kernels.compile_all({"a": {"b"}, "b": {"a"}}, threads)


@pytest.mark.long("journey")
def test_the_kernels_of_the_program_are_found_with_what_they_are_compiled_from() -> None:
    modules = compile_kernels.kernel_modules()
    assert "app.device.control.kernel" in modules["app.device.control.realtime"]
    assert modules.keys() >= set().union(*modules.values())


def test_a_marker_is_found_so_that_what_is_built_for_its_arguments_is_there_too() -> None:
    rehearse_tracking("outline_centroid")

"""Compile every kernel once, on all cores, before processes that would each compile all of them.

`make test` runs a process of tests on each core. With a cold cache every one of them would compile
the same kernels, a few minutes of processor time each. A kernel's module is compiled by importing
it, what is built for its arguments by the first call; the cache (`app.core.compiled`) keeps the
result for whoever needs it next. A cache that was filled by this program before is left as it is.

    python -m tools.compile_kernels
"""

import os
import time
from collections.abc import Mapping, Set
from concurrent.futures import FIRST_COMPLETED, Executor, ProcessPoolExecutor, wait
from graphlib import TopologicalSorter
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path

from app.compose.first_start import rehearse_tracking, rehearsed_file


def kernel_modules() -> Mapping[str, Set[str]]:
    """Return every module that holds kernels with the ones that its import imports before it."""
    import grimp

    graph = grimp.build_graph("app", exclude_type_checking_imports=True, cache_dir=None)
    kernels = graph.find_modules_that_directly_import("app.core.compiled")
    return {name: graph.find_upstream_modules(name) & kernels for name in kernels}


def compile_all(modules: Mapping[str, Set[str]], processes: Executor) -> None:
    """Import every module in one of the processes, after those that it is compiled from.

    Raises:
        graphlib.CycleError: if modules import each other in a circle.
        Exception: whatever the import of a module raises.
    """
    order = TopologicalSorter(modules)
    order.prepare()
    running = {}
    while order.is_active():
        for name in order.get_ready():
            running[processes.submit(import_module_of, name)] = name
        finished, _ = wait(running, return_when=FIRST_COMPLETED)
        for one in finished:
            one.result()
            order.done(running.pop(one))


def import_module_of(name: str) -> None:
    """Import a module and compile what waits in it; a module cannot be sent between processes."""
    import_module(name)
    from app.core.compiled import compile_waiting

    compile_waiting()


def main() -> None:
    """Compile, and say how many modules in how much time."""
    begin = time.perf_counter()
    done = _filled()
    if done.exists():
        print("kernels are ready")
        return
    modules = kernel_modules()
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as processes:
        compile_all(modules, processes)
        list(processes.map(rehearse_tracking, ("model_fit", "outline_centroid")))
    rehearsed_file().touch()
    done.touch()
    print(f"kernels of {len(modules)} modules ready after {time.perf_counter() - begin:.0f} s")


def _filled() -> Path:
    """File in the cache that says that it holds every kernel of these sources, parts and tool."""
    from app.core.compiled import complete_file

    return complete_file("filled", Path(__file__).read_bytes())


if __name__ == "__main__":
    main()

"""Read the marks of tests from their syntax; nothing is run."""

import ast
from collections.abc import Iterator
from pathlib import Path


def marks(folder: Path, name: str) -> Iterator[tuple[str, str, list[ast.expr]]]:
    """Yield each mark of a name on a test function: file, function, the mark's arguments.

    Args:
        folder: of the tests; files are named as paths below its parent.
        name: of the mark, such as `long`.
    """
    dotted = f"pytest.mark.{name}"
    for path in sorted(folder.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if dotted not in text:
            continue
        file = path.relative_to(folder.parent).as_posix()
        functions = (n for n in ast.walk(ast.parse(text)) if isinstance(n, ast.FunctionDef))
        for function in functions:
            for mark in function.decorator_list:
                call = mark if isinstance(mark, ast.Call) else ast.Call(mark, [], [])
                if ast.unparse(call.func) == dotted:
                    yield file, function.name, call.args

"""Whether a plug-in's compiled stage can do harm: read from its source, without running it.

Compiled code checks no index and cannot be stopped. A file of somebody else's is therefore accepted
only if its text shows that neither is needed: every index into `state` and `parameters` is a
constant or runs over a range of constants, what is written to `state` is declared, loops run over
constant ranges, and only functions of the file itself or of a few modules are called. Everything
else is refused with its line. What a function of those modules does with an array that it is given
cannot be seen here; a bounds-checked trial sees that.
"""

from __future__ import annotations

import ast
import importlib
import importlib.util
import math
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, Final, NamedTuple, NoReturn

from app.core import state_vector as sv
from app.core.errors import AcusError

MOST_ROUNDS: Final = 10_000
"""Rounds of all loops of a stage together."""

_MODULES: Final = (
    "app.core.",
    "app.device.control.law_kernels",
    "app.device.control.vectors",
    "app.device.control.segments",
    "app.device.control.operational_space",
    "app.mechanisms.",
)
"""Whose functions and constants a stage may use."""

_BUILTINS: Final = {"min", "max", "abs", "int", "float", "bool", "round"}
_NUMPY: Final = {
    *("abs", "arccos", "arcsin", "arctan", "arctan2", "ceil", "cos", "cosh", "exp", "expm1"),
    *("floor", "hypot", "isfinite", "isinf", "isnan", "log", "log1p", "maximum", "minimum"),
    *("sign", "sin", "sinh", "sqrt", "tan", "tanh"),
}
_COMPILERS: Final = {"stage", "njit"}
_WRITERS: Final = {
    "push": tuple(range(*sv.GUIDE.indices(sv.SLOTS))) + tuple(range(*sv.FORCE.indices(sv.SLOTS))),
    "store": (sv.POTENTIAL, sv.GAIN_WORK),
}
"""Functions of `law_kernels` that write to the state, and what."""

_PLAIN: Final = (
    *(ast.Assign, ast.AugAssign, ast.AnnAssign, ast.Return, ast.If, ast.For, ast.Expr, ast.Pass),
    *(ast.Break, ast.Continue, ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.IfExp),
    *(ast.Call, ast.Name, ast.Attribute, ast.Subscript, ast.Constant, ast.Tuple, ast.keyword),
    *(ast.expr_context, ast.operator, ast.unaryop, ast.boolop, ast.cmpop),
)
_REASONS: Final[dict[type[ast.AST], str]] = {
    ast.While: "a while loop may never end; loop over a range of constants",
    ast.Slice: "a slice of an array is not seen through; use constants as indices",
    ast.ListComp: "a list is allocated in a tick; write a for loop",
    ast.FunctionDef: "a function inside a compiled one; put it at the top level of the file",
    ast.Lambda: "a function inside a compiled one; put it at the top level of the file",
    ast.Raise: "an error would end the loop; return without a force",
    ast.Assert: "an error would end the loop; return without a force",
}

Values = range | tuple[int, ...]


class Checked(NamedTuple):
    """What a file's compiled stage uses.

    Attributes:
        parameters: length that the array of parameters must have at least.
        writes: slots of the state that are written.
    """

    parameters: int
    writes: frozenset[int]


class RefusedStageError(AcusError):
    """A file's stage cannot be accepted; says where and why."""


def check_stage(path: Path, body: list[ast.stmt], declared: Collection[str]) -> Checked:
    """Check the function `step(state, parameters)` of a file and all that it calls in it.

    Args:
        path: of the file, for the message.
        body: its statements.
        declared: names of the slots that it says it writes, lower case.

    Raises:
        RefusedStageError: with file, line and reason.
    """
    return _File(path, body).check({sv.INDEX[name] for name in declared})


class _File:
    """Constants, imports and compiled functions of a file."""

    def __init__(self, path: Path, body: list[ast.stmt]) -> None:
        self.path = path
        self.body = body
        self.modules: dict[str, Any] = {}
        self.imported: dict[str, tuple[str, str]] = {}
        self.records: dict[str, tuple[str, ...]] = {}
        self.constants: dict[str, Any] = {}
        self.kernels: dict[str, ast.FunctionDef] = {}
        self.highest = -1
        self.written: set[int] = set()

    def check(self, declared: set[int]) -> Checked:
        for node in self.body:
            self._read(node)
        step = self.kernels.get("step")
        if step is None:
            line = next((n for n in self.body if getattr(n, "name", "") == "step"), self.body[0])
            self.refuse(line, "step is not compiled; put @stage of core.compiled before it")
        if len(step.args.args) != 2:
            self.refuse(step, "step takes (state, parameters)")
        allowed = set(sv.SUMS) | set(sv.SCENE)
        if strange := sorted(declared - allowed):
            names = [name for name, slot in sv.INDEX.items() if slot in strange]
            self.refuse(
                self._declaration(),
                f"it declares to write {', '.join(names)}, which is the loop's own; a law or effect"
                f" may write {', '.join(n for n, s in sv.INDEX.items() if s in allowed)}",
            )
        rounds = _Function(self, step, ("state", "parameters"), declared, ()).check()
        if rounds > MOST_ROUNDS:
            self.refuse(step, f"its loops run {rounds} rounds in a tick, {MOST_ROUNDS} at most")
        return Checked(self.highest + 1, frozenset(self.written))

    def refuse(self, node: ast.AST, reason: str) -> NoReturn:
        raise RefusedStageError(f"{self.path}, line {getattr(node, 'lineno', 1)}: {reason}")

    def _declaration(self) -> ast.AST:
        for node in self.body:
            names = [t.id for t in _targets(node) if isinstance(t, ast.Name)]
            if "DECLARATION" in names:
                return node
        return self.body[0]

    def _read(self, node: ast.stmt) -> None:
        if isinstance(node, ast.Import):
            for alias in node.names:
                self._import(node, alias.name, alias.asname or alias.name.split(".")[0])
        elif isinstance(node, ast.ImportFrom):
            self._import_from(node)
        elif isinstance(node, ast.FunctionDef):
            if any(_name(d) in _COMPILERS for d in node.decorator_list):
                self.kernels[node.name] = node
        elif isinstance(node, ast.ClassDef):
            if any(_name(base) == "NamedTuple" for base in node.bases):
                self.records[node.name] = tuple(
                    n.target.id
                    for n in node.body
                    if isinstance(n, ast.AnnAssign) and isinstance(n.target, ast.Name)
                )
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            self._constant(node)
        elif not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            self.refuse(
                node,
                "at the top level only imports, constants, functions and records of constants"
                " stand; put this into parameters()",
            )

    def _import(self, node: ast.AST, module: str, name: str) -> None:
        if module.split(".")[0] in ("numba", "ctypes", "cffi", "llvmlite"):
            self.refuse(node, f"{module} gets round the checks; import from app.core.compiled")
        self.modules[name] = module

    def _import_from(self, node: ast.ImportFrom) -> None:
        module = node.module or ""
        for alias in node.names:
            name = alias.asname or alias.name
            whole = f"{module}.{alias.name}"
            if module.split(".")[0] in ("numba", "ctypes", "cffi", "llvmlite"):
                self.refuse(node, f"{module} gets round the checks; import from app.core.compiled")
            if _is_module(whole):
                self.modules[name] = whole
            else:
                self.imported[name] = module, alias.name

    def _constant(self, node: ast.Assign | ast.AnnAssign) -> None:
        for target in _targets(node):
            names = [target] if isinstance(target, ast.Name) else getattr(target, "elts", [])
            value = None if node.value is None else self.value(node.value)
            values = value if isinstance(target, ast.Tuple) else (value,)
            if not isinstance(values, range | tuple) or len(values) != len(names):
                values = (None,) * len(names)
            for name, one in zip(names, values, strict=True):
                if isinstance(name, ast.Name):
                    twice = name.id in self.constants
                    self.constants[name.id] = None if twice else one

    def value(self, node: ast.expr) -> Any:
        """Value of a constant expression: an int, tuple, range or record of ints; else None."""
        if isinstance(node, ast.Constant):
            return node.value if type(node.value) is int else None
        if isinstance(node, ast.Name):
            if node.id in self.imported:
                module, name = self.imported[node.id]
                return _known(_load(module), name)
            return self.constants.get(node.id)
        if isinstance(node, ast.Attribute):
            return self._attribute(node)
        if isinstance(node, ast.Tuple):
            parts = [self.value(n) for n in node.elts]
            return tuple(parts) if all(isinstance(v, int) for v in parts) else None
        if isinstance(node, ast.Call):
            return self._called(node)
        if isinstance(node, ast.BinOp | ast.UnaryOp):
            return _computed(node, self.value)
        return None

    def _attribute(self, node: ast.Attribute) -> Any:
        base = node.value
        if isinstance(base, ast.Name) and base.id in self.modules:
            return _known(_load(self.modules[base.id]), node.attr)
        record = self.value(base)
        return record.get(node.attr) if isinstance(record, dict) else None

    def _called(self, node: ast.Call) -> Any:
        name = _name(node.func)
        if name == "numbered" and node.args and _name(node.args[0]) in self.records:
            first = self.value(node.args[1]) if len(node.args) > 1 else 0
            if isinstance(first, int):
                fields = self.records[_name(node.args[0])]
                return {field: first + k for k, field in enumerate(fields)}
        values = [self.value(argument) for argument in node.args]
        if name == "range" and 1 <= len(values) <= 3 and all(isinstance(v, int) for v in values):
            return range(*values)
        if name == "len" and len(values) == 1 and isinstance(values[0], dict | tuple | range):
            return len(values[0])
        return None


class _Function:
    """One compiled function, as it is called with arrays in some places."""

    def __init__(
        self,
        file: _File,
        node: ast.FunctionDef,
        arrays: tuple[str, ...],
        declared: set[int],
        callers: tuple[str, ...],
        given: tuple[Any, ...] = (),
    ) -> None:
        self.file = file
        self.node = node
        self.declared = declared
        self.callers = (*callers, node.name)
        if node.name in callers:
            file.refuse(node, f"{node.name} calls itself; a stage must not")
        names = [argument.arg for argument in node.args.args]
        self.arrays = {name: kind for name, kind in zip(names, arrays, strict=False) if kind}
        self.loops: dict[str, Values] = {}
        constants = {n: v for n, v in zip(names, given, strict=False) if isinstance(v, int)}
        self.given = {n: v for n, v in constants.items() if n not in {s.id for s in _stores(node)}}
        stored = [n.id for n in _stores(node)]
        counted = [
            n.target.id
            for n in ast.walk(node)
            if isinstance(n, ast.For) and isinstance(n.target, ast.Name)
        ]
        self.locals = {*names, *stored}
        self.counters = {n for n in counted if stored.count(n) == counted.count(n)} - set(names)

    def check(self) -> int:
        """Check the body; returns the rounds of its loops."""
        for name in self.arrays:
            if name in {n.id for n in _stores(self.node)}:
                self.file.refuse(self.node, f"{name} is an array and is given another value")
        return self._block(self.node.body)

    def _block(self, body: list[ast.stmt]) -> int:
        return sum(self._statement(node) for node in body)

    def _statement(self, node: ast.stmt) -> int:
        if isinstance(node, ast.For):
            values = self._range(node)
            name = node.target.id  # type: ignore[attr-defined]
            before = self.loops.get(name)
            self.loops[name] = values
            rounds = max(len(values), 1) * max(self._block(node.body), 1)
            rounds += self._block(node.orelse)
            if before is None:
                del self.loops[name]
            else:
                self.loops[name] = before
            return rounds
        if isinstance(node, ast.If):
            rounds = self._expression(node.test)
            return rounds + self._block(node.body) + self._block(node.orelse)
        if isinstance(node, ast.AnnAssign):
            return self._expression(node.target) + (
                self._expression(node.value) if node.value is not None else 0
            )
        if not isinstance(node, _PLAIN):
            self._refuse_kind(node)
        return sum(
            self._expression(n) for n in ast.iter_child_nodes(node) if isinstance(n, ast.expr)
        )

    def _expression(self, node: ast.expr) -> int:
        if isinstance(node, ast.Subscript):
            return self._subscript(node)
        if isinstance(node, ast.Call):
            return self._call(node)
        if isinstance(node, ast.Name) and node.id in self.arrays:
            self.file.refuse(
                node, f"the array {node.id} may only be indexed or handed to a compiled function"
            )
        if isinstance(node, ast.Attribute):
            base = node.value
            if not (isinstance(base, ast.Name) and base.id not in self.locals):
                self.file.refuse(node, f"{ast.unparse(node)} is not a constant of a module")
            return 0
        if not isinstance(node, _PLAIN):
            self._refuse_kind(node)
        return sum(
            self._expression(n) for n in ast.iter_child_nodes(node) if isinstance(n, ast.expr)
        )

    def _refuse_kind(self, node: ast.AST) -> NoReturn:
        kind = type(node)
        self.file.refuse(
            node, _REASONS.get(kind, f"{kind.__name__} is not used in a compiled stage")
        )

    def _range(self, node: ast.For) -> Values:
        if not isinstance(node.target, ast.Name):
            self.file.refuse(node, "a loop of a stage counts one variable")
        values = None
        if isinstance(node.iter, ast.Call) and _name(node.iter.func) == "range":
            ends = [self._constant(n) for n in node.iter.args]
            if all(isinstance(v, int) for v in ends) and 1 <= len(ends) <= 3 and 0 not in ends[2:]:
                values = range(*ends)
        else:
            values = self.file.value(node.iter)
        if not isinstance(values, range | tuple):
            self.file.refuse(
                node,
                f"the loop over {ast.unparse(node.iter)} may be long or endless; loop over a range"
                " of constants",
            )
        return values

    def _constant(self, node: ast.expr) -> Any:
        if isinstance(node, ast.Name) and node.id in self.given:
            return self.given[node.id]
        names = {n.id for n in ast.walk(node) if isinstance(n, ast.Name)}
        return None if names & self.locals else self.file.value(node)

    def _indices(self, node: ast.expr) -> tuple[int, int] | None:
        """Least and largest value of an index; None if it is no constant and no counter."""
        if isinstance(node, ast.Name) and node.id in self.loops and node.id in self.counters:
            values = self.loops[node.id]
            return (min(values), max(values)) if len(values) else (0, 0)
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub | ast.Mult):
            left, right = self._indices(node.left), self._indices(node.right)
            if left is None or right is None:
                return None
            ends = [_apply(node.op, a, b) for a in left for b in right]
            return min(ends), max(ends)
        value = self._constant(node)
        return (value, value) if isinstance(value, int) else None

    def _subscript(self, node: ast.Subscript) -> int:
        if isinstance(node.value, ast.Call) and isinstance(node.slice, ast.Constant):
            return self._call(node.value)  # of a tuple: the compiler checks the index
        if not isinstance(node.value, ast.Name):
            self.file.refuse(node, f"{ast.unparse(node)}: only a named array is indexed")
        name = node.value.id
        if isinstance(node.slice, ast.Slice):
            self._refuse_kind(node.slice)
        if name not in self.arrays:
            if isinstance(node.slice, ast.Constant) and isinstance(node.ctx, ast.Load):
                return 0  # of a tuple: the compiler checks it
            self.file.refuse(node, f"{ast.unparse(node)}: {name} is no array of the stage")
        found = self._indices(node.slice)
        text = ast.unparse(node)
        if found is None:
            self.file.refuse(
                node, f"the index of {text} is neither a constant nor counted over constants"
            )
        least, most = found
        if least < 0:
            self.file.refuse(node, f"the index of {text} is {least}, below 0")
        if self.arrays[name] == "parameters":
            self.file.highest = max(self.file.highest, most)
        elif most >= sv.SLOTS:
            self.file.refuse(node, f"the index of {text} is {most}; the state has {sv.SLOTS} slots")
        elif isinstance(node.ctx, ast.Store):
            self._write(node, range(least, most + 1), node.slice)
        return 0

    def _write(self, node: ast.AST, slots: Collection[int], index: ast.expr | None) -> None:
        if isinstance(index, ast.Name) and index.id in self.loops:
            slots = tuple(self.loops[index.id])
        self.file.written |= set(slots)
        if undeclared := sorted(set(slots) - self.declared):
            names = [name for name, slot in sv.INDEX.items() if slot in undeclared]
            self.file.refuse(
                node, f"it writes {', '.join(names) or undeclared}, which it does not declare"
            )

    def _call(self, node: ast.Call) -> int:
        name, rounds = ast.unparse(node.func), 0
        arrays: list[str] = []
        for argument in node.args:
            kind = self.arrays.get(argument.id, "") if isinstance(argument, ast.Name) else ""
            arrays.append(kind)
            rounds += 0 if kind else self._expression(argument)
        if node.keywords:
            self.file.refuse(node, f"{name} is called with keywords; give its arguments in order")
        if isinstance(node.func, ast.Name) and node.func.id in self.locals:
            self.file.refuse(node, f"{name} is no function of the file")
        kernel = self.file.kernels.get(name)
        if kernel is not None:
            given = tuple(self._constant(argument) for argument in node.args)
            callee = _Function(self.file, kernel, tuple(arrays), self.declared, self.callers, given)
            return rounds + callee.check()
        if not self._is_known(node.func):
            self.file.refuse(
                node,
                f"{name}() is not one of the functions that a stage may call: its own with @njit,"
                " math, scalar functions of numpy, law_kernels, vectors and mechanisms",
            )
        if "state" in arrays:
            self._write(node, _WRITERS.get(self._source(node.func), ()), None)
        return rounds

    def _source(self, function: ast.expr) -> str:
        name = _name(function)
        module, original = self.file.imported.get(name, ("", name))
        return original if module.endswith("law_kernels") else ""

    def _is_known(self, function: ast.expr) -> bool:
        if isinstance(function, ast.Name):
            if function.id in self.file.imported:
                module, name = self.file.imported[function.id]
                return _is_allowed(module, name)
            return function.id in _BUILTINS and function.id not in self.file.constants
        if isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
            return _is_allowed(self.file.modules.get(function.value.id, ""), function.attr)
        return False


def _is_allowed(module: str, name: str) -> bool:
    if module == "numpy":
        return name in _NUMPY
    if module == "math":
        return callable(getattr(math, name, None))
    return f"{module}.".startswith(tuple(m.rstrip(".") + "." for m in _MODULES))


def _load(module: str) -> Any:
    """Return a module of the program whose constants may be used; None for any other."""
    return importlib.import_module(module) if _is_allowed(module, "") else None


def _known(module: Any, name: str) -> Any:
    value = getattr(module, name, None)
    if type(value) is int or (
        isinstance(value, tuple) and all(type(part) is int for part in value)
    ):
        return value
    return None


def _is_module(name: str) -> bool:
    if not _is_allowed(name, ""):
        return False
    try:
        return importlib.util.find_spec(name) is not None
    except ModuleNotFoundError:
        return False


def _name(node: ast.expr) -> str:
    if isinstance(node, ast.Call):
        return _name(node.func)
    return node.id if isinstance(node, ast.Name) else ""


def _targets(node: ast.stmt) -> list[ast.expr]:
    if isinstance(node, ast.Assign):
        return node.targets
    return [node.target] if isinstance(node, ast.AnnAssign) else []


def _stores(node: ast.AST) -> Iterator[ast.Name]:
    for part in ast.walk(node):
        if isinstance(part, ast.Name) and isinstance(part.ctx, ast.Store):
            yield part


def _apply(operator: ast.operator, a: int, b: int) -> int:
    if isinstance(operator, ast.Add):
        return a + b
    return a - b if isinstance(operator, ast.Sub) else a * b


def _computed(node: ast.BinOp | ast.UnaryOp, value: Any) -> Any:
    if isinstance(node, ast.UnaryOp):
        part = value(node.operand)
        return -part if isinstance(node.op, ast.USub) and isinstance(part, int) else None
    left, right = value(node.left), value(node.right)
    if isinstance(left, tuple) and isinstance(right, tuple) and isinstance(node.op, ast.Add):
        return left + right
    if not (isinstance(left, int) and isinstance(right, int)):
        return None
    if isinstance(node.op, ast.Add | ast.Sub | ast.Mult):
        return _apply(node.op, left, right)
    return left // right if isinstance(node.op, ast.FloorDiv) and right != 0 else None

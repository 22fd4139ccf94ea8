"""A study's picture: error (x) against time (y), both logarithmic, with both limits as lines."""

from importlib import import_module
from pathlib import Path
from typing import Any, Final

from app.core.extras import not_installed
from app.core.messages import sentence
from app.studies.errors import StudyError
from app.studies.findings import Figure
from app.studies.study import Point, Result
from app.studies.table import default_line, failure_lines

_COLOURS: Final = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00")
"""Okabe and Ito: told apart by colour-blind eyes; markers differ as well."""
_MARKERS: Final = "osD^vP"
_INK: Final = "#222222"
_LINE: Final = "#777777"
_MOST_LABELS: Final = 6  # more would lie on top of each other
_LEAST: Final = 1e-16  # an error of exactly zero is drawn here: a logarithm has no zero


def draw(result: Result, path: Path) -> Path:
    """Draw a study's result; the ending of `path` chooses the format (.png, .svg, .pdf).

    Raises:
        StudyError: if matplotlib is missing, or the file cannot be written.
    """
    figure = _empty((8.0, 6.0))
    axes = figure.add_axes((0.11, 0.24, 0.84, 0.68))
    notes: list[Any] = []
    for number, family in enumerate(_families(result)):
        style = number % len(_COLOURS)
        members = _members(result, family)
        notes += _family(axes, family, members, _COLOURS[style], _MARKERS[style])
    _ring(axes, result)
    limits = _limits(axes, result)
    _dress(figure, axes, result)
    _set_apart(figure, axes, notes, limits)
    return _save(figure, path)


def draw_figure(figure: Figure, path: Path) -> Path:
    """Draw a picture of a study's findings; the ending of `path` chooses the format.

    Raises:
        StudyError: if matplotlib is missing, or the file cannot be written.
    """
    canvas = _empty(figure.size)
    figure.draw(canvas)
    return _save(canvas, path)


def _empty(size: tuple[float, float]) -> Any:
    return _matplotlib()[0].Figure(figsize=size, dpi=150, facecolor="white")


def _save(figure: Any, path: Path) -> Path:
    own = {"svg.fonttype": "none", "svg.hashsalt": path.stem}  # text stays text, ids stay the same
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with _matplotlib()[1].rc_context(own):
            figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)
    except (OSError, ValueError) as error:
        raise StudyError(
            sentence("cannot write the picture {path}: {error}", path=path, error=error)
        ) from error
    return path


def _matplotlib() -> tuple[Any, Any]:
    try:
        return import_module("matplotlib.figure"), import_module("matplotlib")
    except ImportError as error:
        what = "matplotlib, which draws the pictures of studies,"
        raise not_installed(StudyError, what, "plots") from error


def _families(result: Result) -> list[str]:
    return list(dict.fromkeys(way.family for way in result.study.ways))


def _members(result: Result, family: str) -> list[tuple[str, Point]]:
    """Points of a family with their labels: its ways at their worst, or its one way everywhere."""
    ways = [way for way in result.study.ways if way.family == family]
    if len(ways) > 1:
        return [(p.way, p) for p in result.summary() if p.family == family]
    return [(p.setting, p) for p in result.points if p.family == family]


def _family(
    axes: Any, family: str, members: list[tuple[str, Point]], colour: str, marker: str
) -> list[Any]:
    """Draw a family; return what is written, its name first."""
    if not members:
        return []
    errors = [max(point.error, _LEAST) for _, point in members]
    seconds = [point.seconds for _, point in members]
    few = len(members) <= _MOST_LABELS
    line = 1.2 if few else 0.0
    axes.plot(errors, seconds, color=colour, marker=marker, markersize=6, linewidth=line)
    ends = (errors.index(min(errors)), errors.index(max(errors)))
    top = seconds.index(max(seconds))
    notes = [_note(axes, family, (errors[top], seconds[top]), 7, colour, 9)]
    for number, ((label, _), x, y) in enumerate(zip(members, errors, seconds, strict=True)):
        if few or number in ends:
            notes.append(_note(axes, label, (x, y), -11, colour, 6))
    return notes


def _ring(axes: Any, result: Result) -> None:
    """Draw a ring round the default where it is at its worst."""
    for worst in result.summary():
        if worst.way == result.study.default:
            at = [max(worst.error, _LEAST)], [worst.seconds]
            axes.plot(*at, marker="o", markersize=13, fillstyle="none", color=_INK)


def _note(axes: Any, text: str, at: tuple[float, float], above: int, colour: str, size: int) -> Any:
    return axes.annotate(
        text,
        at,
        (0, above),
        textcoords="offset points",
        fontsize=size,
        fontweight="bold" if above > 0 else "normal",
        color=colour,
        ha="center",
    )


_BESIDE: Final = (
    (0, 7, "center"),
    (0, -11, "center"),
    (7, -3, "left"),
    (-7, -3, "right"),
    (0, 18, "center"),
    (0, -22, "center"),
    *((0, way * far, "center") for far in range(29, 90, 8) for way in (1, -1)),
)
"""Places of a word seen from its point [pt], the nearest first."""
_NEAR: Final = 6
"""Of so many places a label takes one; the name of a family may stand further away."""


def _set_apart(figure: Any, axes: Any, notes: list[Any], limits: list[Any]) -> None:
    """Move words off each other and off the points: names of families first, labels may go."""
    agg = import_module("matplotlib.backends.backend_agg").FigureCanvasAgg(figure)
    agg.draw()  # the axes take their ranges
    renderer, frame = agg.get_renderer(), axes.get_window_extent()
    box = import_module("matplotlib.transforms").Bbox
    reach = 4.0 * figure.dpi / 72.0
    points = [
        box.from_extents(x - reach, y - reach, x + reach, y + reach)
        for line in axes.get_lines()[: -len(limits)]
        for x, y in line.get_transform().transform(line.get_xydata())
    ]
    taken = points + [note.get_window_extent(renderer) for note in limits]
    for note in sorted(notes, key=lambda one: -one.get_fontsize()):
        own = note.get_position()[1]
        is_name = note.get_fontweight() == "bold"
        near = _BESIDE if is_name else _BESIDE[:_NEAR]
        for right, above, side in sorted(near, key=lambda place: place[:2] != (0, own)):
            note.set_position((right, above))
            note.set_horizontalalignment(side)
            place = note.get_window_extent(renderer)
            inside = frame.containsx(place.x0) and frame.containsx(place.x1)
            if inside and not any(place.overlaps(other) for other in taken):
                taken.append(place)
                break
        else:
            note.set_position((0, own))
            note.set_horizontalalignment("center")
            note.set_visible(is_name)


def _limits(axes: Any, result: Result) -> list[Any]:
    """Draw the two limits; return what is written at them."""
    study = result.study
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(0.16, 0.2)
    axes.axhline(study.deadline.value, color=_LINE, linestyle="--", linewidth=1.0)
    least, most = axes.get_ylim()
    axes.set_ylim(least, max(most, 2.0 * study.deadline.value))  # room for what is written there
    axes.axvline(study.perception.value, color=_LINE, linestyle=":", linewidth=1.4)
    deadline = axes.annotate(
        study.deadline.label,
        (0.01, study.deadline.value),
        (0, 3),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        fontsize=7,
        color=_INK,
    )
    perception = axes.annotate(
        _wrapped([study.perception.label], 64),
        (study.perception.value, 0.98),
        (3, 0),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        fontsize=7,
        color=_INK,
        rotation=90,
        va="top",
    )
    return [deadline, perception]


def _dress(figure: Any, axes: Any, result: Result) -> None:
    study = result.study
    axes.set_title(study.title, fontsize=11, color=_INK)
    axes.set_xlabel(study.error_label, color=_INK)
    axes.set_ylabel("time of one call [s]", color=_INK)
    axes.grid(True, which="major", color="#DDDDDD", linewidth=0.6)
    axes.set_axisbelow(True)
    foot = [f"Reference: {study.reference}", default_line(result)]
    foot += [f"Fails: {line}" for line in failure_lines(result)] or ["No way fails."]
    figure.text(0.02, 0.015, _wrapped(foot), fontsize=6.5, color=_INK, va="bottom")


def _wrapped(lines: list[str], width: int = 150) -> str:
    from textwrap import fill

    return "\n".join(fill(line, width, subsequent_indent="    ") for line in lines)

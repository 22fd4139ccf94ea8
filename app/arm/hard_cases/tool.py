"""Hard cases of the eyes: all but round blobs, highlights, cut tools, grazing shafts and rings."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from math import inf, sqrt
from typing import Any, Final

import numpy as np

from app.arm.eyes import (
    AreaMoments,
    FulcrumStatus,
    ShaftLine,
    ToolBlob,
    ToolMiss,
    ToolMissReason,
    ToolRenderer,
    ToolScene,
    TrocarStatus,
    eyes,
    find_tool,
    meet_lines,
    moments,
    solve_trocar,
)
from app.arm.laparoscopy import RING_HALF, ToolBody, TrocarRing
from app.core.arrays import FloatArray, unit
from app.core.units import DEGREE
from app.studies.hard_cases.case import HardCase, analytic, answers, digits
from app.tracking.cameras.camera import Image
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.obstacles import Highlight, highlight

DECLARATION: Final[dict[str, Any]] = {
    "title": "The tool and the trocar in pictures",
    "subsystems": {"tool and trocar": "calibration"},
}

_Way = Callable[..., Any]

LYING: Final = ToolScene(np.array([0.1, 0.03, 0.009]), np.array([0.9, 0.3, 0.0]))
TOOL: Final = ToolBody()


# --- pixels ---------------------------------------------------------------------------------------
def whole(points: FloatArray, edge_px: float = 1e-12) -> AreaMoments:
    """Moments of whole pixels whose outline is known to `edge_px`."""
    count = len(points)
    return moments(points, np.ones(count), np.ones(count), np.ones(count, np.bool_), edge_px)


def ellipse(ratio: float, angle: float, half: float = 40.0) -> FloatArray:
    """Pixels of an ellipse, (n, 2)."""
    y, x = np.mgrid[-60:61, -60:61].astype(np.float64)
    along, across = x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)
    inside = (along / half) ** 2 + (across * ratio / half) ** 2 <= 1.0
    return np.column_stack([x[inside], y[inside]])


def _far_away() -> HardCase:
    reference = digits("principal axis of an all but round blob far away")
    pixels = np.array(reference.given).reshape(-1, 2)

    return HardCase(
        subsystem="tool and trocar",
        case="principal axis of an all but round blob far from the origin",
        given="7 pixels 3 px round about (4e6, 4e6), axes alike to 1e-3",
        way=whole,
        found=lambda way: way(pixels).angle,
        reference=reference,
        unit="rad",
        bound=1e-12,
        beyond=answers("no axis for a disc", lambda: whole(ellipse(1.0, 0.0), 0.1).angle is None),
    )


def _round() -> HardCase:
    y, x = np.mgrid[-60:61, -60:61].astype(np.float64)
    inside = np.hypot(x - 0.3, y - 0.2) <= 40.0
    disc = np.column_stack([x[inside], y[inside]])

    return HardCase(
        subsystem="tool and trocar",
        case="a round blob has no principal axis",
        given="whole pixels within 40 px of (0.3, 0.2) px, outline known to 0.1 px",
        way=whole,
        found=lambda way: float(way(disc, 0.1).angle is None),
        reference=analytic("1: none", 1.0),
        unit="1",
        bound=0.0,
        beyond=answers(
            "one that is longer by a twentieth has one",
            lambda: whole(ellipse(1.05, 70.0 * DEGREE), 0.1).angle is not None,
        ),
    )


def _steep() -> HardCase:
    return HardCase(
        subsystem="tool and trocar",
        case="axis of a blob that is longer by a twentieth, and steep",
        given="ellipse of 40 px and 38 px at 70°",
        way=whole,
        found=lambda way: way(ellipse(1.05, 70.0 * DEGREE)).angle,
        reference=analytic("70°", 70.0 * DEGREE),
        unit="rad",
        bound=0.02,  # whole pixels
        beyond=answers(
            "an upright axis is +90°, never -90°",
            lambda: whole(np.array([[0.0, -1.0], [0.0, 0.0], [0.0, 1.0]])).angle == 0.5 * np.pi,
        ),
    )


# --- pictures -------------------------------------------------------------------------------------
@cache
def camera() -> CameraModel:
    """Return the left camera."""
    return eyes()[0]


@cache
def renderer() -> ToolRenderer:
    """Return what draws its pictures."""
    return ToolRenderer(camera(), TOOL)


def lamp(image: Image, uv: FloatArray, sd_px: float) -> Image:
    """Reflect a lamp in a picture."""
    return highlight(image, Highlight(uv, sd_px, 400.0), np.random.default_rng(0))


def tool_in(image: Image) -> ToolBlob:
    """Return the tool in a picture.

    Raises:
        ArithmeticError: if there is none.
    """
    found = find_tool(image)
    if isinstance(found, ToolMiss):
        raise ArithmeticError(found.reason.value)
    return found


def _bleached() -> HardCase:
    def centre(way: _Way) -> Any:
        plain = renderer().render(LYING)
        place = camera().project(LYING.p_tip - 0.06 * LYING.axis_world)[0][0]
        return way(lamp(plain, place, 4.0)).moments.centre - tool_in(plain).moments.centre

    def two() -> bool:
        other = ToolScene(np.array([0.1, -0.12, 0.009]), np.array([0.9, 0.3, 0.0]))
        found = find_tool(renderer().render(replace(LYING, others=(other,))))
        return isinstance(found, ToolMiss) and found.reason is ToolMissReason.TWO_TOOLS

    return HardCase(
        subsystem="tool and trocar",
        case="a lamp's reflection across the shaft is bridged",
        given="a tool on the table, bleached over its whole width near the tip",
        way=tool_in,
        found=centre,
        reference=analytic("the centre without the lamp", (0.0, 0.0)),
        unit="px",
        bound=1.0,  # of some 150 px; the reflection is wider than the shaft
        beyond=answers("two tools are named", two),
    )


def _two_tools() -> HardCase:
    other = ToolScene(np.array([0.1, -0.12, 0.009]), np.array([0.9, 0.3, 0.0]))
    across = ToolScene(np.array([0.06, -0.03, 0.009]), np.array([0.3, -0.9, 0.0]))
    wrong = ToolMissReason.TWO_TOOLS, ToolMissReason.NOT_STRAIGHT

    def named_so(way: _Way) -> list[float]:
        found = [way(renderer().render(replace(LYING, others=(one,)))) for one in (other, across)]
        return [
            float(isinstance(seen, ToolMiss) and seen.reason is reason)
            for seen, reason in zip(found, wrong, strict=True)
        ]

    return HardCase(
        subsystem="tool and trocar",
        case="two tools in the picture, apart and crossing, are never taken for one",
        given="the second 150 mm beside the first; the second across it",
        way=find_tool,
        found=named_so,
        reference=analytic("1: two tools; 1: not one straight thing", (1.0, 1.0)),
        unit="1",
        bound=0.0,
        beyond=answers(
            "with one taken away the other is found",
            lambda: isinstance(find_tool(renderer().render(other)), ToolBlob),
        ),
    )


def _cut() -> HardCase:
    scene = ToolScene(np.array([-0.03, 0.33, 0.2]), np.array([0.25, -1.0, -0.1]))

    def angle(way: _Way) -> Any:
        return way(renderer().render(scene)).moments.angle

    ends = camera().project(scene.p_tip - np.array([[0.0], [0.08]]) * scene.axis_world)[0]
    slope = ends[1] - ends[0]
    return HardCase(
        subsystem="tool and trocar",
        case="axis of a tool that the picture's edge cuts",
        given="the handle beyond the edge",
        way=tool_in,
        found=angle,
        reference=analytic("the shaft's picture", float(np.arctan(slope[1] / slope[0]))),
        unit="rad",
        bound=0.02,  # what is cut off aslant
        beyond=answers("said to be cut", lambda: tool_in(renderer().render(scene)).cut),
    )


# --- fulcrum --------------------------------------------------------------------------------------
def exact_lines(values: Sequence[float]) -> list[ShaftLine]:
    """Lines without errors of (point, direction) each."""
    rows = np.array(values).reshape(-1, 6)
    return [ShaftLine(row[:3], unit(row[3:]), np.zeros((6, 6))) for row in rows]


def _all_but_parallel() -> HardCase:
    reference = digits("point nearest to lines 1e-5 rad from parallel")

    def parallel() -> bool:
        rows = [(0.01 * k, 0.02 * k * k, 0.3, 0.1, 0.2, -1.0) for k in range(5)]
        found = meet_lines(exact_lines([value for row in rows for value in row]))
        return found.status is FulcrumStatus.DEGENERATE and not found.p_world.any()

    return HardCase(
        subsystem="tool and trocar",
        case="fulcrum of a shaft that turned by 1e-5 rad",
        given="five lines that miss each other by nanometres",
        way=meet_lines,
        found=lambda way: way(exact_lines(reference.given)).p_world,
        reference=reference,
        unit="m",
        bound=1e-10,  # ε / 1e-5, several times
        beyond=answers("named DEGENERATE for parallel lines", parallel),
    )


def _parallel() -> HardCase:
    rows = [(0.01 * k, 0.02 * k * k, 0.3, 0.1, 0.2, -1.0) for k in range(5)]
    lines = exact_lines([value for row in rows for value in row])

    def turned() -> bool:
        lean = [(*row[:3], 0.1 + 1e-3 * k, *row[4:]) for k, row in enumerate(rows)]
        found = meet_lines(exact_lines([value for row in lean for value in row]))
        return found.status is not FulcrumStatus.DEGENERATE

    return HardCase(
        subsystem="tool and trocar",
        case="lines that are all parallel have no fulcrum",
        given="five lines apart, all along (0.1, 0.2, -1)",
        way=meet_lines,
        found=lambda way: [
            float((met := way(lines)).status is FulcrumStatus.DEGENERATE),
            *met.p_world,
        ],
        reference=analytic("1: degenerate, and no place is given", (1.0, 0.0, 0.0, 0.0)),
        unit="1, m",
        bound=0.0,
        beyond=answers("judged by their distances once they turn by 1 mrad", turned),
    )


def _along_the_skin() -> HardCase:
    fulcrum, lean = np.array([0.15, 0.02, 0.0]), 1e-3
    lines = []
    for k in range(8):
        axis = unit([np.cos(0.8 * k), np.sin(0.8 * k), -lean])
        lift = np.array([0.0, 0.0, 1e-6 * (-1) ** k])
        lines.append(ShaftLine(fulcrum - 0.1 * axis + lift, axis, np.zeros((6, 6))))

    return HardCase(
        subsystem="tool and trocar",
        case="fulcrum of a shaft that grazes the skin",
        given="eight lines 1 mrad above the skin, each 1 µm too high or too low",
        way=meet_lines,
        found=lambda way: way(lines).p_world,
        reference=analytic("the point that they turn about", fulcrum),
        unit="m",
        bound=2e-6,
        beyond=answers(
            "named CONTRADICTORY for lines that miss each other by centimetres",
            lambda: (
                meet_lines(
                    [
                        replace(x, p_world=x.p_world + np.array([0.0, 0.0, 0.03 * k]))
                        for k, x in enumerate(lines)
                    ]
                ).status
                is FulcrumStatus.CONTRADICTORY
            ),
        ),
    )


def _edge_on() -> HardCase:
    models = eyes()
    centre, radius = np.array([0.05, 0.0, 0.02]), 0.016

    def outlines(beyond: float) -> tuple[FloatArray, FloatArray]:
        """Pictures of a ring seen at this angle from its normal by the left camera."""
        view = unit(models[0].centre - centre)
        other = unit(models[1].centre - centre)
        side = unit(other - (other @ view) * view)
        normal = np.cos(beyond) * view + np.sin(beyond) * side
        first = unit(np.cross(normal, view))
        turn = np.linspace(0.0, 2.0 * np.pi, 60, endpoint=False)[:, None]
        ring = centre + radius * (np.cos(turn) * first + np.sin(turn) * np.cross(normal, first))
        return models[0].project(ring)[0], models[1].project(ring)[0]

    return HardCase(
        subsystem="tool and trocar",
        case="centre of a trocar seen 70° from its normal",
        given="60 exact points of its outline in both pictures",
        way=solve_trocar,
        found=lambda way: way(models, outlines(70.0 * DEGREE), radius).p_world,
        reference=analytic("the circle's centre", centre),
        unit="m",
        bound=1e-7,  # where Gauss–Newton stops
        beyond=answers(
            "named GRAZING from 80°",
            lambda: (
                solve_trocar(models, outlines(84.0 * DEGREE), radius).status is TrocarStatus.GRAZING
            ),
        ),
    )


def _in_the_rings_plane() -> HardCase:
    ring, diameter = TrocarRing(np.zeros(3), np.array([0.0, 0.0, 1.0])), 0.010
    slope = 1e-6
    axis = np.array([1.0, 0.0, -slope])
    length = sqrt(1.0 + slope**2)
    room = ring.inner - 0.5 * diameter * length / slope - RING_HALF / slope

    def none() -> bool:
        flat = ring.room(np.array([1.0, 0.0, 0.0]), diameter)
        return bool(flat == -inf and ring.room(np.array([1.0, 0.0, -1e-300]), diameter) == -inf)

    return HardCase(
        subsystem="tool and trocar",
        case="room in the trocar for a shaft that all but lies in the ring's plane",
        given="10 mm thick, 1 µrad from the plane",
        way=TrocarRing.room,
        found=lambda way: way(ring, axis, diameter),
        reference=analytic("inner - r √(1 + s²) / s - h / s", room),
        unit="m",
        bound=1e-9,  # of 6000 m
        beyond=answers("in the plane: minus infinity, nothing is divided by 0", none),
    )


CASES: Final = (
    _far_away(),
    _round(),
    _steep(),
    _bleached(),
    _two_tools(),
    _cut(),
    _all_but_parallel(),
    _parallel(),
    _along_the_skin(),
    _edge_on(),
    _in_the_rings_plane(),
)
"""Blobs, pictures, lines, rings."""

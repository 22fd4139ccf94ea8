"""Defects of the eyes' hard cases: squares that cancel, boxes for axes, the least norm."""

from dataclasses import replace
from typing import Any

import numpy as np

from app.arm.eyes import FulcrumStatus, ShaftLine, find_tool, meet_lines, solve_trocar
from app.arm.hard_cases.tool import LYING, renderer, tool_in, whole
from app.arm.laparoscopy import RING_HALF, TrocarRing
from app.core.arrays import FloatArray, unit
from app.tracking.cameras.camera import Image
from app.tracking.stereo.triangulation import triangulate
from tests.hard.defects import Defect


def in_one_pass(points: FloatArray) -> Any:
    n, (x, y) = len(points), points.mean(axis=0)
    xx, yy = (points**2).sum(axis=0) - n * np.array([x * x, y * y])
    xy = points.prod(axis=1).sum() - n * x * y
    return replace(whole(points), angle=0.5 * float(np.arctan2(2.0 * xy, xx - yy)))


def always(points: FloatArray, edge_px: float) -> Any:
    found = whole(points, edge_px)
    c = found.covariance
    return replace(found, angle=0.5 * float(np.arctan2(2.0 * c[0, 1], c[0, 0] - c[1, 1])))


def by_quotient(points: FloatArray) -> Any:
    found = whole(points)
    c = found.covariance
    return replace(found, angle=0.5 * float(np.arctan(2.0 * c[0, 1] / (c[0, 0] - c[1, 1]))))


def colour_alone(image: Image) -> Any:
    green = image[..., 1].astype(float) - 0.5 * (image[..., 0].astype(float) + image[..., 2])
    pixels = np.argwhere(green > 25.0)[:, ::-1].astype(np.float64)
    return replace(tool_in(image), moments=whole(pixels))


def of_the_box(image: Image) -> Any:
    found = tool_in(image)
    wide, high = np.ptp(found.pixels, axis=0)
    angle = float(np.sign(found.moments.covariance[0, 1]) * np.arctan2(high, wide))
    return replace(found, moments=replace(found.moments, angle=angle))


def normal_equations(lines: list[ShaftLine]) -> Any:
    across = [np.eye(3) - np.outer(line.axis_world, line.axis_world) for line in lines]
    right = sum(a @ line.p_world for a, line in zip(across, lines, strict=True))
    solved = np.asarray(np.linalg.solve(sum(across), right), dtype=np.float64)
    return replace(meet_lines(lines), p_world=solved)


def least_norm(lines: list[ShaftLine]) -> Any:
    across = [np.eye(3) - np.outer(line.axis_world, line.axis_world) for line in lines]
    right = sum(a @ line.p_world for a, line in zip(across, lines, strict=True))
    solved = np.linalg.pinv(sum(across)) @ right
    return replace(meet_lines(lines), p_world=solved, status=FulcrumStatus.FOUND)


def on_the_skin(lines: list[ShaftLine]) -> Any:
    met = [x.p_world - x.p_world[2] / x.axis_world[2] * x.axis_world for x in lines]
    return replace(meet_lines(lines), p_world=met[0])


def of_ellipses(models: Any, seen: Any, radius: float) -> Any:
    found = solve_trocar(models, seen, radius)
    rays = [m.undistort(uv)[0].mean(axis=0) for m, uv in zip(models, seen, strict=True)]
    poses = models[0].T_camera_world, models[1].T_camera_world
    spread = np.array([np.eye(2) * 1e-8] * 2)
    return replace(found, p_world=triangulate(poses, np.array(rays), spread).p_world)


def by_the_angle(ring: TrocarRing, towards: FloatArray, thick: float) -> float:
    lean = float(np.float32(np.arccos(-unit(towards)[2])))
    return float(ring.inner - 0.5 * thick / np.cos(lean) - RING_HALF * np.tan(lean))


DEFECTS = {
    "tool and trocar": {
        "principal axis of an all but round blob far from the origin": Defect(
            "sums of squares less the squared mean", in_one_pass
        ),
        "a round blob has no principal axis": Defect(
            "arc tangent of what rounding to pixels leaves", always
        ),
        "axis of a blob that is longer by a twentieth, and steep": Defect(
            "arc tangent of the quotient", by_quotient
        ),
        "a lamp's reflection across the shaft is bridged": Defect(
            "pixels of the colour alone", colour_alone
        ),
        "two tools in the picture, apart and crossing, are never taken for one": Defect(
            "the first of them", lambda _: find_tool(renderer().render(LYING))
        ),
        "axis of a tool that the picture's edge cuts": Defect("diagonal of its box", of_the_box),
        "fulcrum of a shaft that turned by 1e-5 rad": Defect(
            "normal equations, which square the angle", normal_equations
        ),
        "lines that are all parallel have no fulcrum": Defect(
            "the point of least norm", least_norm
        ),
        "fulcrum of a shaft that grazes the skin": Defect(
            "where a line meets the skin", on_the_skin
        ),
        "centre of a trocar seen 70° from its normal": Defect(
            "middle of its outlines, triangulated", of_ellipses
        ),
        "room in the trocar for a shaft that all but lies in the ring's plane": Defect(
            "the angle in single precision", by_the_angle
        ),
    },
}

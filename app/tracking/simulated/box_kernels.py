"""Ray tracing of the surroundings, axis-aligned boxes, into camera pictures (compiled).

Every pixel is the mean over rays spread as the lens spreads a point (see `sampling`).
"""

from typing import Any

import numpy as np

from app.core.compiled import njit


@njit
def _box_hit(o: Any, d: Any, box: Any) -> Any:
    """Ray against an axis-aligned box (slab test): (distance, axis of the face), or (inf, 0)."""
    near, far, axis = -np.inf, np.inf, 0
    for k in range(3):
        inverse = 1.0 / (d[k] if abs(d[k]) > 1e-12 else 1e-12)
        first, second = (box[k] - o[k]) * inverse, (box[k + 3] - o[k]) * inverse
        if first > second:
            first, second = second, first
        if first > near:
            near, axis = first, k
        far = min(far, second)
    return (near, axis) if 0.0 < near <= far else (np.inf, 0)


@njit
def trace_boxes(
    image: Any, rays: Any, pattern: Any, rotation: Any, o: Any, boxes: Any, colours: Any, light: Any
) -> None:
    """Paint axis-aligned boxes of the world into a float picture (H, W, 3), in place.

    `rotation` and `o` are the camera's pose; `boxes` (n, 6) low and high corners [m]; `light` and
    the shading as in `draw_needle`, but in world. Between boxes the picture stays as it was.
    """
    d, one = np.empty(3), np.empty(3)
    n = pattern.shape[0]
    for v in range(image.shape[0]):
        for u in range(image.shape[1]):
            one[:] = 0.0
            x, y = rays[v + 1, u + 1, 0], rays[v + 1, u + 1, 1]
            xu = rays[v + 1, u + 2, 0] - x
            yv = rays[v + 2, u + 1, 1] - y
            for i in range(n):
                dx, dy = x + pattern[i, 0] * xu, y + pattern[i, 1] * yv
                for k in range(3):
                    d[k] = rotation[k, 0] * dx + rotation[k, 1] * dy + rotation[k, 2]
                best, which, face = np.inf, -1, 0
                for b in range(boxes.shape[0]):
                    t, axis = _box_hit(o, d, boxes[b])
                    if t < best:
                        best, which, face = t, b, axis
                if which < 0:
                    for k in range(3):
                        one[k] += image[v, u, k]
                    continue
                facing = -light[face] if d[face] > 0.0 else light[face]
                haze = 1.0 / (1.0 + (best / 1.2) ** 2)  # less light further back
                glow = (light[3] + light[4] * max(0.0, facing)) * (0.35 + 0.65 * haze)
                for k in range(3):
                    one[k] += colours[which, k] * glow
            for k in range(3):
                image[v, u, k] = one[k] / n

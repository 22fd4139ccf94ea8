"""What a calibration says about itself, in lines for people."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.messages import sentence
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.lens_choice import reach
from app.tracking.calibration.selection import Dropped
from app.tracking.calibration.views import BoardView
from app.tracking.optics.lens import LensModel


@dataclass(frozen=True)
class ViewResidual:
    """A view and how well it fits.

    Attributes:
        name: of the picture.
        rms_px: root mean square distance of its corners, 2D [px].
        role: `used`, `outlier` or `held_back`.
    """

    name: str
    rms_px: float
    role: str


def mono_remarks(
    name: str,
    used: list[BoardView],
    adjusted: Adjusted,
    dropped: tuple[Dropped, ...],
    residuals: tuple[ViewResidual, ...],
) -> list[str]:
    """Say what was dropped, left out, not covered or not square."""
    notes = [f"{name}: {one.text}" for one in dropped]
    notes += [
        sentence(
            "{name}: {r_name} does not fit ({r_rms_px:.2f} px against {adjusted_rms_px:.2f} px): "
            "left out",
            name=name,
            r_name=r.name,
            r_rms_px=r.rms_px,
            adjusted_rms_px=adjusted.rms_px,
        )
        for r in residuals
        if r.role == "outlier"
    ]
    notes += coverage_notes(name, used)
    focal, spread = adjusted.state.parameters[0, :2], adjusted.sd()[:2]
    ratio, ratio_sd = float(focal[1] / focal[0]), float(np.hypot(*(spread / focal)))
    if abs(ratio - 1.0) > max(0.01, 4.0 * ratio_sd):
        notes.append(
            sentence(
                "{name}: fy/fx = {ratio:.4f}: the pixels or the squares are not square; measure "
                "the print in both directions",
                name=name,
                ratio=ratio,
            )
        )
    return notes


def lens_remarks(
    name: str,
    lens: LensModel,
    adjusted: Adjusted,
    used: Sequence[BoardView],
    five_px: float | None,
) -> list[str]:
    """Say that the lens is none for five coefficients, and which model it got."""
    if lens is LensModel.BROWN or five_px is None:
        return []
    angle = np.degrees(reach(adjusted.state.parameters[0], used))
    return [
        sentence(
            "{name}: this lens is wider than the five-coefficient model, or bends otherwise: "
            "seen up to {angle:.0f}° off its axis, {five_px:.3f} px remain with five "
            "coefficients, {adjusted_rms_px:.3f} px with the {lens_words}: calibrated with that",
            name=name,
            angle=angle,
            five_px=five_px,
            adjusted_rms_px=adjusted.rms_px,
            lens_words=lens.words,
        )
    ]


def unrefined_remarks(
    name: str, given: Sequence[BoardView], taken: Sequence[BoardView]
) -> list[str]:
    """Say whose corners fit better as the finder gave them."""
    changed = [old.name for old, new in zip(given, taken, strict=True) if old is not new]
    if not changed:
        return []
    named = ", ".join(changed[:5]) + (f" and {len(changed) - 5} more" if len(changed) > 5 else "")
    return [
        sentence(
            "{name}: corners fit better unrefined and are taken so (blur, noise): {named}",
            name=name,
            named=named,
        )
    ]


def coverage_notes(name: str, views: Sequence[BoardView]) -> list[str]:
    """Say where the distortion is not measured but continued."""
    pixels = np.concatenate([view.pixels for view in views])
    centre = np.array(views[0].image_size) / 2.0
    reach = float(np.linalg.norm(pixels - centre, axis=1).max() / np.linalg.norm(centre))
    if reach >= 0.75:
        return []
    return [
        sentence(
            "{name}: corners reach {reach:.0%} of the way to the picture's corners; distortion "
            "beyond is not measured: show the board at the edges too",
            name=name,
            reach=reach,
        )
    ]


def stereo_remarks(
    names: tuple[str, str],
    pairs: int,
    changed: tuple[str, ...],
    residuals: tuple[ViewResidual, ...],
    adjusted: Adjusted,
) -> list[str]:
    """Say which corner orders were mended, which pairs left out, and if cameras look swapped."""
    notes: list[str] = []
    if changed:
        notes.append(
            sentence(
                "{mended} of {pairs} pairs had their corners numbered from opposite ends; "
                "mended: {mended_names}",
                mended=len(changed),
                pairs=pairs,
                mended_names=", ".join(changed),
            )
        )
    notes += [
        sentence(
            "{r_name} does not fit the other pairs ({r_rms_px:.2f} px against "
            "{adjusted_rms_px:.2f} px): left out",
            r_name=r.name,
            r_rms_px=r.rms_px,
            adjusted_rms_px=adjusted.rms_px,
        )
        for r in residuals
        if r.role == "outlier"
    ]
    p_right = adjusted.state.T_right_left.inverse().translation
    if p_right[0] < 0.0:
        notes.append(
            sentence(
                "camera {right_name} stands {distance_mm:.0f} mm to the left of camera "
                "{left_name}: the two may be swapped",
                right_name=names[1],
                distance_mm=-p_right[0] * 1e3,
                left_name=names[0],
            )
        )
    return notes


def size_remarks(names: tuple[str, str], pair: tuple[BoardView, BoardView]) -> list[str]:
    """Say that the cameras' pictures differ in size: the pair fits, the trainer cannot use it."""
    sizes = [view.image_size for view in pair]
    if sizes[0] == sizes[1]:
        return []
    (w0, h0), (w1, h1) = sizes
    return [
        sentence(
            "pictures of different sizes, {left_name} {w0}x{h0}, {right_name} {w1}x{h1}: the "
            "trainer takes both cameras at one size; set both to it and take the pictures again",
            left_name=names[0],
            w0=w0,
            h0=h0,
            right_name=names[1],
            w1=w1,
            h1=h1,
        )
    ]

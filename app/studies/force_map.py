"""Study: what the hand feels of 2 N that are wanted, by the printed law and by virtual work.

MuJoCo's closed-loop statics of the same links are the judge: the torques of a law go to its motors,
the hub is held, and the force that holds it is read.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.control.table import machine_stages
from app.device.control.transmission import Transmission, transmission_stage
from app.device.links.link import Link
from app.mechanisms.lever import force_map_kernel, printed_force_kernel
from app.mechanisms.pantograph import ForceLaw, inverse, jacobian, joint_torques, needle_at
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.studies.findings import Cell, Figure, Findings, Sheet
from app.studies.in_use import called
from app.studies.references.mujoco_pantograph import felt_in_mujoco
from app.studies.study import Case, Limit, Prepared, Setting, Study, Way

DECLARATION: Final[dict[str, Any]] = {
    "title": "Force at the hand: printed law and virtual work against closed-loop statics",
    "question": "Which law turns a wanted force at the hand into motor torques?",
    "reference": "MuJoCo's statics of the closed loop, hub held, to about 2e-6 N",
}

_DEVICE: Final = "icube"
_WANTED: Final = 2.0  # [N]
_FELT: Final = 0.1  # [N]
_SHARE: Final = 0.1  # of the force
_CALLS: Final = 20_000
_TILTS_DEG: Final = (0.0, 15.0, 30.0, 39.0, 45.0)
_LEAN: Final = float(np.deg2rad(90.0))  # the tip leans away from the motors
_WAYS: Final = {"virtual work": False, "printed 4.12": True}
_SIDES: Final = ("in the tilt plane", "sideways")

Force = tuple[float, float, float]
Lever = tuple[float, float, float, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class _Pose:
    """A needle with the wanted force across it."""

    profile: PantographProfile
    tilt: float
    force: Force
    lever: Lever
    jacobian: FloatArray


def pose(profile: PantographProfile, tilt: float, sideways: bool) -> _Pose:
    """Needle at a tilt [rad] with 2 N wanted across it, in the tilt plane or sideways."""
    geometry = profile.pantograph
    lean = np.tan(tilt) * np.array([np.cos(_LEAN), np.sin(_LEAN)])
    needle = needle_at(geometry, geometry.fulcrum[:2] + geometry.fulcrum[2] * lean)
    dx, dy, dz = needle.axis.tolist()
    side = np.array([-np.sin(_LEAN), np.cos(_LEAN), 0.0])
    force = _WANTED * (side if sideways else np.cross(side, needle.axis))
    fx, fy, fz = force.tolist()
    return _Pose(
        profile,
        tilt,
        (fx, fy, fz),
        (dx, dy, dz, needle.l_in, needle.l_out),
        jacobian(geometry, inverse(geometry, needle.p3)),
    )


def felt(where: _Pose, gamma: FloatArray) -> FloatArray:
    """Force [N] that a still hand feels of a tool force, by MuJoCo; shape (3,).

    Raises:
        SimulationError: if MuJoCo is not installed; names the extra.
    """
    torques = joint_torques(where.jacobian, gamma)
    return felt_in_mujoco(where.profile, where.tilt, _LEAN, torques)


@njit
def _often(
    fx: float,
    fy: float,
    fz: float,
    dx: float,
    dy: float,
    dz: float,
    l_in: float,
    l_out: float,
    printed: bool,
    calls: int,
) -> tuple[float, float]:
    # The force changes a little in each call, so that nothing is computed once for all.
    x = y = 0.0
    for c in range(calls):
        if printed:
            gx, gy = printed_force_kernel(fx + 1e-18 * c, fy, fz, dx, dy, dz, l_in, l_out)
        else:
            gx, gy = force_map_kernel(fx + 1e-18 * c, fy, fz, dx, dy, dz, l_in, l_out)
        x, y = x + gx, y + gy
    return x / calls, y / calls


def tool_force(where: _Pose, printed: bool, calls: int = 1) -> FloatArray:
    """Tool force [N] of a law, shape (2,)."""
    return np.array(_often(*where.force, *where.lever, printed, calls))


def _case(setting: Setting) -> Case:
    values = setting.values
    where = pose(load_pantograph(_DEVICE), np.deg2rad(values["tilt_deg"]), bool(values["sideways"]))
    return Case(
        where,
        lambda gamma: float(np.linalg.norm(felt(where, gamma) - np.array(where.force))),
        max(_FELT, _SHARE * _WANTED),
    )


def _way(name: str, printed: bool) -> Way:
    def prepare(case: Case) -> Prepared:
        return Prepared(lambda: tool_force(case.data, printed, _CALLS), _CALLS)

    return Way(name, name, prepare, used=printed_force_kernel if printed else force_map_kernel)


def _in_use() -> object:
    profile = load_pantograph(_DEVICE)
    table = machine_stages(profile, [], [], Link.of([], []))
    chosen = next(stage for stage in table if stage.name == "transmission")
    virtual_work = Transmission.of(profile, ForceLaw.VIRTUAL_WORK).stage().parameters
    kernel = "force_map_kernel" if (chosen[2] == virtual_work).all() else "printed_force_kernel"
    return called(transmission_stage, kernel)


def _findings() -> Findings:
    profile = load_pantograph(_DEVICE)
    rows: list[tuple[Cell, ...]] = []
    for tilt_deg in range(0, 46, 5):
        cells: list[Cell] = [tilt_deg]
        for sideways in (False, True):
            where = pose(profile, np.deg2rad(tilt_deg), sideways)
            for printed in _WAYS.values():
                gamma = tool_force(where, printed)
                cells.append(float(np.linalg.norm(felt(where, gamma))))
        rows.append(tuple(cells))
    headings = (f"{way}, {side} [N]" for side in _SIDES for way in _WAYS)
    sheet = Sheet(
        "felt",
        f"{_DEVICE}: felt in MuJoCo for {_WANTED:g} N wanted",
        ("tilt [°]", *headings),
        tuple(rows),
    )
    return Findings(
        (sheet,),
        (Figure("felt", lambda figure: _draw(figure, sheet), (8.0, 4.5)),),
        (
            f"At 45° the printed law 4.12 gives {rows[-1][2]:.3f} N for {_WANTED:g} N, virtual "
            f"work {rows[-1][1]:.3f} N.",
        ),
    )


def _draw(figure: Any, sheet: Sheet) -> None:
    axes = figure.add_subplot(1, 1, 1)
    table = np.array(sheet.rows, dtype=np.float64)
    for column, (style, colour) in enumerate(
        (("o-", "#0072B2"), ("s-", "#D55E00"), ("^--", "#56B4E9"), ("v--", "#E69F00"))
    ):
        axes.plot(table[:, 0], table[:, column + 1], style, color=colour, markersize=4)
        axes.lines[-1].set_label(sheet.columns[column + 1])
    fine = np.linspace(0.0, 45.0, 100)
    theory = _WANTED / np.cos(np.deg2rad(fine)) ** 2
    axes.plot(fine, theory, ":", color="#222222", label=f"{_WANTED:g} N / cos² tilt")
    axes.axhspan(_WANTED * (1 - _SHARE), _WANTED * (1 + _SHARE), color="#EEEEEE", label="unnoticed")
    axes.set(xlabel="tilt of the needle [°]", ylabel="force at the hand in MuJoCo [N]")
    axes.grid(True, color="#DDDDDD", linewidth=0.5)
    axes.legend(fontsize=7)
    figure.tight_layout()


STUDY: Final = Study(
    error_label=f"error of the felt force [N], {_WANTED:g} N wanted",
    ways=tuple(_way(name, printed) for name, printed in _WAYS.items()),
    settings=tuple(
        Setting(f"{tilt:g}°, {side}", {"tilt_deg": tilt, "sideways": float(number)})
        for number, side in enumerate(_SIDES)
        for tilt in _TILTS_DEG
    ),
    case=_case,
    deadline=Limit(1e-6, "1 µs: a third of the 3 µs that a whole tick may take"),
    perception=Limit(max(_FELT, _SHARE * _WANTED), "0.2 N: 10 % of the force, felt"),
    default="virtual work",
    because="the printed law is felt to be wrong from a tilt of 18°",
    in_use=_in_use,
    findings=_findings,
)

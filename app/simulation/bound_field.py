"""A field of tissue bound to the robot's frame: what the loop's kernels need to look into it."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.field import FieldTissue, TissueField, TissueKind
from app.imaging.field.walking import holding as holding_codes
from app.simulation.errors import SimulationError
from app.simulation.scene import TissueLayer

CodesOf = Callable[[FloatArray], NDArray[np.intp]]

MOVING: Final = frozenset(
    {TissueKind.ORGAN, TissueKind.VESSEL, TissueKind.GUT, TissueKind.HEART, TissueKind.LUNG}
)
"""What goes along with breathing where nobody says otherwise; the wall of the body stays."""

IN_WALL: Final = "intercostal"
"""Vessels of such a name lie in the wall, and stay."""

AT_SPINE: Final = 0.5
"""Share of the target's motion that is left at the spine: an estimate, none found by organ."""

_LIMITS: Final = (0.5, 1.2)
_INFLATED: Final = 2.0  # the lung's share at most
_TURNS: Final = 6
_SHALLOW: Final = 0.03  # [m] nearer to the spine than this, place makes no difference


@dataclass(frozen=True, slots=True, eq=False)
class BoundField:
    """A field in the robot's frame. Who holds it keeps the arrays that the loop looks into.

    Attributes:
        tissue: the field.
        T_world_patient: registration; takes LPS metres.
        p_target: target at rest in world [m], shape (3,); it goes along with all of breathing.
    """

    tissue: TissueField
    T_world_patient: RigidTransform
    p_target: FloatArray
    _spine: FloatArray = field(init=False)
    _lung: FloatArray = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_target", frozen(self.p_target, (3,), "p_target"))
        object.__setattr__(self, "_spine", self._towards_spine())
        object.__setattr__(self, "_lung", self._within_lung())

    @property
    def voxel_of_world(self) -> FloatArray:
        """World [m] -> voxel (i, j, k), shape (3, 4)."""
        inverse = self.tissue.inverse_mm
        rotation = self.T_world_patient.rotation.T
        turn = inverse[:3, :3] @ rotation / MILLIMETRE
        return np.column_stack([turn, inverse[:3, 3] - turn @ self.T_world_patient.translation])

    def head(self) -> dict[str, float]:
        """Return the places of `tissue_walk.FieldPlaces` but its first and its last two."""
        labels, distance = self.tissue.labels, self.tissue.distance
        nz, ny, nx = labels.shape
        rows = self.voxel_of_world
        named = {
            f"{name}_{column}": float(value)
            for name, row in zip("ijk", rows, strict=True)
            for column, value in zip("xyz0", row, strict=True)
        }
        least, most = _LIMITS
        return {
            "labels": float(labels.ctypes.data),
            "distance": float(distance.ctypes.data),
            "nx": nx,
            "ny": ny,
            "nz": nz,
            **named,
            "spacing": float(self.tissue.spacing_mm.min()) * MILLIMETRE,
            **_linear("spine", self._spine),
            "spine_least": least,
            "spine_most": most,
            **_linear("lung", self._lung),
        }

    def rows(self, values: Sequence[TissueLayer]) -> FloatArray:
        """Return the table of `tissue_walk.TissueRow` by code, shape (codes, 4).

        Raises:
            SimulationError: if there is not one row of values for each code.
        """
        tissues = self.tissue.tissues
        if len(values) != len(tissues):
            raise SimulationError(
                sentence(
                    "the field has {tissues} tissues and {rows} rows of values; "
                    "give one for each code",
                    tissues=len(tissues),
                    rows=len(values),
                )
            )
        return np.array(
            [
                (
                    float(_goes_along(one)) if value.moves is None else value.moves,
                    float(one.kind is TissueKind.LUNG),
                    float(value.rigid),
                    float(one.kind is TissueKind.AIR),
                )
                for one, value in zip(tissues, values, strict=True)
            ]
        )

    def at_rest(
        self, p_world: FloatArray, breath: FloatArray, codes_of: CodesOf | None = None
    ) -> FloatArray:
        """Return where the tissue at points rests, as `tissue_walk` looks it up in the loop.

        Args:
            p_world: points [m], shape (n, 3).
            breath: displacement of what goes along with all of breathing [m], shape (n, 3).
            codes_of: tells the codes of tissues at rest at points [m], (n, 3) -> (n,); None for
                the field itself. A reference knows better.
        """
        look = codes_of or self._codes
        resting = p_world.copy()
        moved = np.flatnonzero(breath.any(axis=1))
        moved = moved[self._moves[look(p_world[moved])]]
        points, way = p_world[moved], breath[moved]
        share = np.zeros(len(moved))
        held = np.zeros(len(moved), bool)  # halved: it came to what stays
        for _ in range(_TURNS):
            codes = look(points - share[:, None] * way)
            lies = self._moves[codes]
            now = self._shares(codes, points - share[:, None] * way)
            share = np.where(lies, np.where(held, share, now), 0.5 * share)
            held |= ~lies
        lies = self._moves[look(points - share[:, None] * way)]
        resting[moved] -= np.where(lies, share, 0.0)[:, None] * way
        return resting

    @property
    def _moves(self) -> NDArray[np.bool_]:
        """Return whether each tissue goes along with breathing, by code."""
        return np.array([_goes_along(one) for one in self.tissue.tissues])

    def _codes(self, p_world: FloatArray) -> NDArray[np.intp]:
        patient = (p_world - self.T_world_patient.translation) @ self.T_world_patient.rotation
        return self.tissue.codes_at(patient / MILLIMETRE)

    def _shares(self, codes: NDArray[np.intp], p_world: FloatArray) -> FloatArray:
        """Share of breathing of what rests at points and moves."""
        share = np.clip(self._spine[0] + p_world @ self._spine[1:], *_LIMITS)
        lung = np.array([one.kind is TissueKind.LUNG for one in self.tissue.tissues])
        volume = np.clip(self._lung[0] + p_world @ self._lung[1:], 0.0, _INFLATED)
        return np.asarray(share * np.where(lung[codes], volume, 1.0))

    def _towards_spine(self) -> FloatArray:
        """Constant and gradient of the share by place: 1 at the target, less towards the spine."""
        bones = self._centres(TissueKind.BONE)
        if not len(bones):
            return np.array([1.0, 0.0, 0.0, 0.0])
        spine = float(np.percentile(bones[:, 1], 90.0))
        way = spine - float(self._patient(self.p_target)[1])
        if way < _SHALLOW:
            return np.array([1.0, 0.0, 0.0, 0.0])
        posterior = self.T_world_patient.rotation[:, 1]
        gradient = -(1.0 - AT_SPINE) / way * posterior
        return np.array([1.0 - float(gradient @ self.p_target), *gradient])

    def _within_lung(self) -> FloatArray:
        """Constant and gradient of the lung's share: 1 at its base, or at a target in it; 0 at its
        apex.
        """
        lung = self._centres(TissueKind.LUNG)
        if not len(lung) or (height := float(np.ptp(lung[:, 2]))) < _SHALLOW:
            return np.array([1.0, 0.0, 0.0, 0.0])
        apex = float(lung[:, 2].max())
        holds = holding_codes(self.tissue, self._patient(self.p_target) / MILLIMETRE)
        in_lung = any(self.tissue.tissues[code].kind is TissueKind.LUNG for code in holds)
        reference = apex - float(self._patient(self.p_target)[2]) if in_lung else height
        superior = self.T_world_patient.rotation[:, 2]
        gradient = -superior / max(reference, _SHALLOW)
        origin = self.T_world_patient.translation
        return np.array([apex / max(reference, _SHALLOW) - float(gradient @ origin), *gradient])

    def _patient(self, p_world: FloatArray) -> FloatArray:
        rotation, origin = self.T_world_patient.rotation, self.T_world_patient.translation
        return np.asarray(rotation.T @ (p_world - origin))

    def _centres(self, kind: TissueKind) -> FloatArray:
        """Return voxels of a kind in patient coordinates [m], at most some thousands, (n, 3)."""
        codes = [tissue.code for tissue in self.tissue.of_kind(kind)]
        if not codes:
            return np.zeros((0, 3))
        step = max(1, round(2.0 / float(self.tissue.spacing_mm.min())))
        chosen = np.isin(self.tissue.labels[::step, ::step, ::step], codes)
        ijk = step * np.argwhere(chosen)[:, ::-1]
        affine = self.tissue.affine_mm
        return np.asarray((ijk @ affine[:3, :3].T + affine[:3, 3]) * MILLIMETRE)


def _goes_along(tissue: FieldTissue) -> bool:
    return tissue.kind in MOVING and not tissue.name.casefold().startswith(IN_WALL)


def _linear(name: str, values: FloatArray) -> dict[str, float]:
    return {
        key: float(value)
        for key, value in zip((name, f"{name}_x", f"{name}_y", f"{name}_z"), values, strict=True)
    }


def stand_in() -> BoundField:
    """Return a field of eight voxels with every kind of tissue, for who only compiles a scene."""
    codes = np.zeros((2, 2, 2), np.uint8)
    tissues = tuple(FieldTissue(code, kind) for code, kind in enumerate(TissueKind))
    tissue = TissueField(codes, codes.astype(np.int8), np.eye(4), tissues)
    return BoundField(tissue, RigidTransform(np.eye(3), np.zeros(3)), np.zeros(3))


def holding(array: FloatArray, bound: BoundField) -> FloatArray:
    """Return an array that says where the field lies, and that keeps the field as long as it is."""
    keeper = weakref.finalize(array, _let_go, bound)
    keeper.atexit = False
    return array


def _let_go(bound: BoundField) -> None:
    """Do nothing: that this can be called is what keeps the field."""

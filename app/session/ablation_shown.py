"""An ablation as it is shown, live and afterwards: zones, shafts left in place, margins."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.events import Event
from app.planning.ablation.zone import Zone
from app.planning.errors import PlanError
from app.session.ablation import ABLATE, PLACE, AblationState, shaft


@dataclass(frozen=True, slots=True, eq=False)
class MarginsShown:
    """MarginsShown at places of a lesion's surface, and what they come to.

    Attributes:
        at_mm: places, LPS, shape (n, 3).
        margin_mm: there, negative where not covered, shape (n,).
        least_mm: least of all.
        share: of the lesion that is covered, 0 to 1.
        vessels: great vessels within 3 mm, by name, each with its distance [mm].
        reached: what else the zone reaches, by name, each with its volume in it [mm3].
        zones: of the electrodes.
    """

    at_mm: FloatArray
    margin_mm: FloatArray
    least_mm: float
    share: float
    vessels: tuple[tuple[str, float], ...]
    reached: tuple[tuple[str, float], ...]
    zones: tuple[Zone, ...]

    @property
    def least_at(self) -> int:
        """Return the number of the place with the least margin."""
        return int(np.argmin(self.margin_mm))


@dataclass(frozen=True, slots=True, eq=False)
class AblationShown:
    """What is shown of an ablation.

    Attributes:
        planned: by the planned electrodes.
        reached: by those in place; None before the generator.
        shafts_mm: electrodes in place, from skin to tip, LPS, shape (n, 2, 3).
        off_mm: distance of each one's tip from its planned place.
        wanted_mm: margin that is wanted.
        generator: its name.
        ex_vivo: whether its table was measured without blood.
        setting: power [W] and time [min]; None before the generator.
    """

    planned: MarginsShown
    reached: MarginsShown | None
    shafts_mm: FloatArray
    off_mm: tuple[float, ...]
    wanted_mm: float
    generator: str
    ex_vivo: bool
    setting: tuple[float, float] | None

    @property
    def newest(self) -> MarginsShown:
        """Return what was reached, or what is planned before."""
        return self.planned if self.reached is None else self.reached

    @classmethod
    def of_state(cls, state: AblationState) -> AblationShown:
        """Return what is shown of a running attempt."""
        row = None if state.row is None else state.table.rows[state.row]

        def margins(done: Any) -> MarginsShown:
            return MarginsShown(
                done.surface_mm,
                done.margin_mm,
                done.least_mm,
                done.share,
                tuple((one.name, one.distance_mm) for one in done.vessels),
                tuple((one.name, one.volume_mm3) for one in done.reached),
                done.zones,
            )

        off = [
            float(np.linalg.norm(one.tip_mm - plan.plan.target_mm))
            for one, plan in zip(state.electrodes, state.plans, strict=False)
        ]
        return cls(
            margins(state.planned),
            None if state.reached is None else margins(state.reached),
            shaft(state.electrodes),
            tuple(off),
            state.part.margin_mm,
            str(state.table.title),
            state.table.ex_vivo,
            None if row is None else (row.power_w, row.minutes),
        )

    @classmethod
    def of_events(cls, events: Iterable[Event]) -> AblationShown | None:
        """Return what is shown of a record; None where nothing was ablated, or it is damaged."""
        shafts, off = list[FloatArray](), list[float]()
        for event in events:
            data: dict[str, Any] = dict(event.data)
            try:
                if data.get("step") == PLACE:
                    tip = np.array(data["tip_lps_mm"], np.float64)
                    axis = np.array(data["axis_lps"], np.float64)
                    shafts.append(np.stack([tip - float(data["depth_mm"]) * axis, tip]))
                    off.append(float(data["off_mm"]))
                elif data.get("step") == ABLATE:
                    return _of_document(data, shafts, off)
            except (LookupError, TypeError, ValueError, PlanError):
                return None
        return None


def _of_document(data: dict[str, Any], shafts: list[FloatArray], off: list[float]) -> AblationShown:
    places = np.array(data["map"]["at_lps_mm"], np.float64).reshape(-1, 3)

    def margins(name: str) -> MarginsShown:
        one = data[name]
        values = np.array(data["map"][f"{name}_mm"], np.float64)
        if len(values) != len(places) or not len(values) or not np.isfinite(values).all():
            raise ValueError(name)
        return MarginsShown(
            read_only(places),
            read_only(values),
            float(one["least_margin_mm"]),
            float(one["share"]),
            tuple((str(v["name"]), float(v["distance_mm"])) for v in one["vessels"]),
            tuple((str(v["name"]), float(v["volume_mm3"])) for v in one["reached"]),
            tuple(
                Zone(
                    np.array(z["centre_lps_mm"], np.float64),
                    np.array(z["axis_lps"], np.float64),
                    0.5 * float(z["long_mm"]),
                    0.5 * float(z["short_mm"]),
                )
                for z in one["zones"]
            ),
        )

    return AblationShown(
        margins("planned"),
        margins("reached"),
        read_only(np.array(shafts, np.float64).reshape(-1, 2, 3)),
        tuple(off),
        float(data["wanted_mm"]),
        str(data["generator"]),
        data["ex_vivo"] is True,
        (float(data["power_w"]), float(data["minutes"])),
    )

"""`acus registration` and `acus plate`: fiducials touched on a plate, what they say of a target."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from app.commands.answer import Answer, Commands
from app.commands.reader_language import template
from app.commands.shown import Each
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.planning.registration.check import PointCheck, RegistrationCheck
    from app.planning.registration.uncertainty import FiducialError

app = Commands(help="Check where cameras or a phantom stand, with a plate.")
plates = Commands(help="Fiducial plates (docs/registration.md).")

Touched = Annotated[Path, typer.Option(help="Touched points in world, CSV or YAML, mm.")]
Plate = Annotated[str, typer.Option(help="Name of a plate, or a .yaml file.")]
Picked = Annotated[Path | None, typer.Option(help="Beads in the CT (LPS), CSV or YAML, mm.")]
Target = Annotated[
    str | None, typer.Option(metavar="X,Y,Z", help="Target in world [mm]; by default below P_I.")
]

DEFAULT_TARGET_MM = (0.0, 160.56, 30.0)
"""60 mm below the fulcrum: the middle of the needle's range."""


RANK = 150


def register(root: typer.Typer) -> None:
    """Add `registration` and `plate` to the command line."""
    root.add_typer(app, name="registration")
    root.add_typer(plates, name="plate")


@app.command()
def check(
    touched: Touched,
    plate: Plate = "stepped-plate",
    picked: Picked = None,
    target: Target = None,
) -> Answer:
    """Register touched fiducials to a plate.

    Says what is wrong, and the error at a target.

    Ends with code 3 if the points do not fit the plate.
    """
    from app.planning.registration.check import RegistrationCheck
    from app.planning.registration.plate import load_plate
    from app.planning.registration.points import read_points

    found = RegistrationCheck.of(
        load_plate(plate), read_points(touched), read_points(picked) if picked else None
    )
    point = _target(target)
    return Answer(_document(found, point), _lines(found, point), yes=found.trusted)


@plates.command("list")
def list_plates() -> Answer:
    """List the plates that come with the program."""
    from app.planning.registration.plate import load_plate, plate_names

    rows = [load_plate(name).model_dump(mode="json") for name in plate_names()]
    shown = Each("plates", "{name}  {fiducials:#} fiducials  {description}")
    return Answer({"plates": rows}, shown=shown)


@app.command("list")
def list_checks() -> Answer:
    """List the saved checks, newest first."""
    from app.planning.registration.record import Registrations

    rows = [
        {
            "id": record.id,
            "created": record.created.isoformat(),
            "plate": record.plate.name,
            "touched": len(record.touched),
            "picked": len(record.picked),
            "rig": record.rig,
            "calibration": record.calibration,
            "simulated": record.simulated,
            "trusted": record.check().trusted,
        }
        for record in Registrations.own().records()
    ]
    row = template(
        "{id}  {plate}  {touched} touched, {picked} picked  {rig}  {trusted:?good|does not fit}"
    )
    empty = sentence("no registration checks in {folder}", folder=Registrations.own().folder)
    none = [] if rows else [empty]
    return Answer({"checks": rows}, none, shown=Each("checks", row))


def _target(text: str | None) -> "FloatArray":
    import numpy as np

    from app.core.errors import ConfigurationError
    from app.core.units import MILLIMETRE

    if text is None:
        return np.array(DEFAULT_TARGET_MM) * MILLIMETRE
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != 3 or not np.isfinite(values).all():
        raise ConfigurationError(
            sentence("--target {target}: three numbers X,Y,Z in mm are needed", target=text)
        )
    return np.array(values) * MILLIMETRE


def _lines(result: "RegistrationCheck", point: "FloatArray") -> list[str]:
    from app.planning.registration import words

    lines = [*words.troubles(result), *words.technician_lines(result)]
    for part in (result.world, result.patient):
        for name, residual in zip(part.names, _lengths_mm(part), strict=True) if part else ():
            lines.append(f"  {name}  residual {residual:.2f} mm")
    agreement = words.agreement_or_reason(result, point)
    told = agreement if isinstance(agreement, str) else words.student_line(agreement)
    return [*lines, words.target_line(result, point), told, *words.MEANING]


def _document(result: "RegistrationCheck", point: "FloatArray") -> dict[str, Any]:
    import numpy as np

    from app.core.confidence import covariance_radius
    from app.core.units import MILLIMETRE
    from app.planning.registration import words

    agreement = words.agreement_or_reason(result, point)
    said = isinstance(agreement, str)
    spread = result.spread(point)
    return {
        "plate": result.plate.name,
        "trusted": result.trusted,
        "troubles": list(words.troubles(result)),
        "touched": _part(result.world),
        "picked": _part(result.patient) if result.patient else None,
        "target_world_mm": (point / MILLIMETRE).tolist(),
        "tre_rms_mm": float(np.sqrt(np.trace(result.expected(point)))) / MILLIMETRE,
        "tre_95_mm": covariance_radius(spread) / MILLIMETRE,
        "tre_condition": result.world.condition,
        "tre_covariance_mm2": (spread / MILLIMETRE**2).tolist(),
        "agreement_95_mm": None if isinstance(agreement, str) else agreement.radius / MILLIMETRE,
        "agreement_reason": agreement if said else "",
    }


def _part(part: "PointCheck") -> dict[str, Any]:
    from app.core.units import MILLIMETRE

    transform = part.fit.T_measured_reference
    return {
        "names": list(part.names),
        "residuals_mm": _lengths_mm(part),
        "fre_mm": part.fit.fre / MILLIMETRE,
        "fle_mm": _fle(part.fiducial),
        "rotation": transform.rotation.tolist(),
        "translation_mm": (transform.translation / MILLIMETRE).tolist(),
    }


def _fle(error: "FiducialError") -> dict[str, float]:
    from app.core.units import MILLIMETRE

    values = {"rms": error.rms, "lower_95": error.lower, "upper_95": error.upper}
    return {name: value / MILLIMETRE for name, value in values.items()}


def _lengths_mm(part: "PointCheck") -> list[float]:
    from app.core.units import MILLIMETRE

    lengths: list[float] = ((part.fit.residuals**2).sum(axis=1) ** 0.5 / MILLIMETRE).tolist()
    return lengths

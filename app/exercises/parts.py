"""Parts of an exercise file: CT, plan, placement, effects, tissue."""

from collections.abc import Mapping
from dataclasses import fields
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Self

from pydantic import (
    AfterValidator,
    Discriminator,
    Field,
    GetJsonSchemaHandler,
    SerializerFunctionWrapHandler,
    Tag,
    field_validator,
    model_serializer,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from app.core.configuration import FieldText, Strict
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.remedies import is_word, words
from app.imaging.series import NO_REMEDY
from app.planning.placement import PatientOrientation, Placement
from app.planning.plan import Plan
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.scene import TissueLayer

Triple = tuple[float, float, float]
NotNegative = Annotated[float, Field(ge=0.0)]
KILOPASCAL = 1e3


class ViewName(StrEnum):
    """What an exercise shows beside the CT."""

    LIVE_OVERLAY = "live_overlay"
    """The needle, live, on the slices."""
    BULLSEYE = "bullseye"
    """Offsets and angles against the planned path."""
    THREE_D = "three_d"
    """Robot, skin and bone in space."""
    CAMERAS = "cameras"
    """The pictures of the tracking cameras."""
    FORCE_GAUGE = "force_gauge"
    """Force along the needle."""
    TARGET_MOTION = "target_motion"
    """Where breathing moves the target."""


TELLING = frozenset(
    {
        ViewName.LIVE_OVERLAY,
        ViewName.BULLSEYE,
        ViewName.CAMERAS,
        ViewName.FORCE_GAUGE,
        ViewName.TARGET_MOTION,
    }
)
"""Views that tell where the needle or its target is now: none of them where control scans guide."""


def _of_the_table(name: str) -> str:
    if is_word(name):
        return name
    *most, last = map(repr, words())
    raise PydanticCustomError("remedy", f"Input should be {', '.join(most)} or {last}")


class _RemedyNames:
    """Lists the remedies in the JSON Schema, as they are when it is made."""

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        return {"type": "string", "enum": list(words())}


RemedyName = Annotated[str, AfterValidator(_of_the_table), _RemedyNames()]


class PhantomCt(Strict):
    """The procedural torso: one patient for each seed."""

    seed: Annotated[int, Field(ge=0)] = 1


class Ct(Strict):
    """Which CT: either the phantom or a folder with a DICOM series.

    Attributes:
        phantom: the procedural patient.
        folder: a folder; relative to the exercise file.
        series: SeriesInstanceUID, where the folder holds several.
        remedy: what is asked for in reading it, of a folder: the name of a CT remedy.
        digest: SHA-256 of the geometry and voxels that the exercise was made on, of a folder
            (`Volume.digest`): another CT in that folder is refused. None where nobody has looked.
    """

    phantom: PhantomCt | None = None
    folder: Path | None = None
    series: str | None = None
    remedy: RemedyName = NO_REMEDY
    digest: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = None

    @model_validator(mode="after")
    def _one_of_two(self) -> "Ct":
        if (self.phantom is None) == (self.folder is None):
            raise ValueError(
                sentence("give either phantom: {{seed: ...}} or folder: ..., one of the two")
            )
        if "\0" in str(self.folder):
            raise ValueError(sentence("folder holds a character that no path has"))
        if self.series is not None and self.folder is None:
            raise ValueError(sentence("series goes with folder; the phantom has one series only"))
        if self.digest is not None and self.phantom is not None:
            raise ValueError(sentence("digest goes with folder; the phantom is known by its seed"))
        if self.remedy != NO_REMEDY and self.folder is None and self.phantom is not None:
            raise ValueError(sentence("remedy goes with folder; the phantom is read as it is"))
        return self


class StructurePart(Strict):
    """A file of structures that belongs to the exercise's CT.

    Attributes:
        file: DICOM SEG, RTSTRUCT, `.seg.nrrd` or NIfTI labels; beside the exercise file, or in the
            folder `structures` of the per-user data.
        risks: name of a structure in the file -> how far the needle has to stay off [mm].
    """

    file: Path
    risks: Mapping[str, Annotated[float, Field(ge=0.0, le=50.0)]] = Field(default_factory=dict)

    @field_validator("file")
    @classmethod
    def _is_a_path(cls, file: Path) -> Path:
        if "\0" in str(file) or file.name in ("", "."):
            raise ValueError(sentence("file names a file of structures"))
        return file


class PlanPoints(Strict):
    """A plan by its two points, DICOM LPS [mm]."""

    entry_mm: Triple
    target_mm: Triple
    name: str = "plan"

    @model_validator(mode="after")
    def _is_a_plan(self) -> "PlanPoints":
        self.plan()
        return self

    def plan(self) -> Plan:
        """Return it as the value that planning uses."""
        return Plan(self.entry_mm, self.target_mm, self.name)  # type: ignore[arg-type]


class OwnPlan(Strict):
    """The student plans: the target is given, the entry is not.

    Attributes:
        own: says so.
        target_mm: DICOM LPS [mm]; None for the lesion of the phantom.
        trial_entry_mm: entry of those who try the exercise without a window, which no student is
            shown; with `target_mm`. None for the phantom's own entry, to its own lesion.
    """

    own: Literal[True]
    target_mm: Triple | None = None
    trial_entry_mm: Triple | None = None

    @model_serializer(mode="wrap")
    def _as_before(self, handler: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """Leave out what is younger than the rest and not asked for: older records stay equal."""
        document: dict[str, Any] = handler(self)
        if self.trial_entry_mm is None:
            document.pop("trial_entry_mm", None)
        return document

    @model_validator(mode="after")
    def _trial_has_both_ends(self) -> Self:
        if self.trial_entry_mm is not None and self.target_mm is None:
            raise ValueError(
                sentence("plan: trial_entry_mm goes with target_mm: give both, or neither")
            )
        return self


OF_LUNG_PATHS: Final = frozenset(
    {
        "planned_emphysema",
        "planned_fissures",
        "planned_intercostal",
        "planned_lung",
        "planned_pleural_angle",
        "planned_rib_border",
    }
)
"""Metrics of the path report of a lung biopsy, which is made where one of them is asked for."""

OF_OWN_PLANS: Final = frozenset({"plan_score", "plan_clearance"}) | OF_LUNG_PATHS
"""Metrics of the path that the student chose: there is none where the exercise gives it."""


def _tag(value: object) -> str:
    if isinstance(value, str):
        return "name"
    is_own = isinstance(value, OwnPlan) or (isinstance(value, Mapping) and "own" in value)
    return "own" if is_own else "points"


PlanChoice = Annotated[
    Annotated[PlanPoints, Tag("points")]
    | Annotated[Literal["phantom_default"], Tag("name")]
    | Annotated[OwnPlan, Tag("own")],
    Discriminator(_tag),
]
"""Two points; `phantom_default`, the plan that the phantom itself proposes; or the student's."""


class PlacementPart(Strict):
    """How the patient lies: orientation, then a free rotation vector about world x, y, z [°]."""

    orientation: PatientOrientation = PatientOrientation.SUPINE
    rotation_deg: Triple = (0.0, 0.0, 0.0)

    @model_validator(mode="after")
    def _is_a_placement(self) -> "PlacementPart":
        if max(abs(angle) for angle in self.rotation_deg) > 360.0:
            raise ValueError(sentence("rotation_deg must be within ±360°"))
        return self

    def placement(self) -> Placement:
        """Return it as the value that planning uses."""
        return Placement(self.orientation, self.rotation_deg)


class EffectPart(Strict):
    """One named effect; its presence is the switch. The simulation knows the valid parameters.

    Attributes:
        parameters: SI values that replace the effect's defaults.
        model: which of the effect's ways to compute it; empty chooses its first.
        organ: what it acts on; empty means everything.
    """

    parameters: dict[str, Annotated[float, Field(strict=True)]] = Field(default_factory=dict)
    model: str = ""
    organ: str = ""


class LawPart(Strict):
    """One named force law; its presence is the switch. The device knows the valid parameters.

    Attributes:
        parameters: SI values that replace the law's defaults.
    """

    parameters: dict[str, Annotated[float, Field(strict=True)]] = Field(default_factory=dict)


class TipShape(StrEnum):
    """How a needle's tip is ground."""

    SYMMETRIC = "symmetric"
    """Pointed all round, as a trocar's stylet: it goes straight."""
    BEVEL = "bevel"
    """From one side: it cuts a curved way."""


class NeedlePart(Strict):
    """The needle that is held, in the hand and in the simulated tissue.

    Attributes:
        gauge: of the needle; how thick it is says how it bends.
        length_mm: hub to tip; None for the one in the device's profile.
        tip: how it is ground; a bevel calls for the effect `bevel`.
    """

    gauge: Annotated[int, FieldText("Needle")] = 18
    length_mm: Annotated[
        Annotated[float, Field(gt=0.0)] | None,
        FieldText("Length of the needle, 0 for the device's own"),
    ] = None
    tip: TipShape = TipShape.SYMMETRIC

    @field_validator("gauge")
    @classmethod
    def _known(cls, gauge: int) -> int:
        if gauge not in OUTER_DIAMETER:
            known = ", ".join(map(str, OUTER_DIAMETER))
            raise ValueError(
                sentence("no needle of {gauge} G; there are {known}", gauge=gauge, known=known)
            )
        return gauge


class LayersFrom(StrEnum):
    """Where the layers of tissue come from."""

    FILE = "file"
    """As the exercise has them; else the simulation's own."""
    CT = "ct"
    """From the CT along the path, when the attempt begins."""


class TissueSource(StrEnum):
    """Source of the tissue that the simulated needle meets."""

    AUTO = "auto"
    """Layers where every needle within reach would meet the same, else the field."""
    LAYERS = "layers"
    """In layers along the planned path, wherever the needle goes."""
    FIELD = "field"
    """Looked up where the needle is, in the patient in three dimensions."""


class LayerPart(Strict):
    """A slab of tissue along the path, counted from the skin.

    Attributes:
        name: for display.
        thickness_mm: along the path.
        side_stiffness_kpa: lateral foundation stiffness [kPa = kN/m²].
        friction: kinetic shaft friction per inserted length [N/m].
        static_friction: break-away friction per inserted length [N/m].
        viscous_friction: per inserted length [N·s/m²].
        moves: share of the displacement by breathing that it goes along with, 0 to 1; None: all of
            it from the breathing organ inwards, nothing above.
        puncture_force: of the membrane it begins with, for 18 G [N]; 0 for none.
        toughness: fracture toughness [J/m²]; cutting costs it times the outer diameter.
        indentation_stiffness: of the membrane pushed in by the tip, linear part [N/m].
        indentation_hardening: quadratic part of it [N/m²].
        pressing: of an 18 G tip on what it goes into, beside cutting [N].
        relaxation_share: of a quick indentation's resistance that relaxes.
        relaxation_time: time constant of that [s].
        rigid: bone; the last layer, where the needle stops.
    """

    name: str
    thickness_mm: Annotated[float, Field(gt=0.0)]
    side_stiffness_kpa: NotNegative = 20.0
    friction: NotNegative = 10.57
    static_friction: NotNegative = 18.45
    viscous_friction: NotNegative = 250.0
    moves: Annotated[float, Field(ge=0.0, le=1.0)] | None = None
    puncture_force: NotNegative = 0.0
    toughness: NotNegative = 0.0
    indentation_stiffness: NotNegative = 2.0
    indentation_hardening: NotNegative = 2300.0
    relaxation_share: Annotated[float, Field(ge=0.0, lt=1.0)] = 0.0
    relaxation_time: Annotated[float, Field(gt=0.0)] = 0.5
    rigid: bool = False
    pressing: NotNegative = 0.0

    @property
    def thickness(self) -> float:
        """Thickness [m]."""
        return self.thickness_mm * MILLIMETRE

    @property
    def side_stiffness(self) -> float:
        """Lateral foundation stiffness [N/m²]."""
        return self.side_stiffness_kpa * KILOPASCAL

    def layer(self) -> TissueLayer:
        """Return it as the value that the simulation uses.

        Raises:
            SimulationError: if its membrane has no stiffness.
        """
        return TissueLayer(**{one.name: getattr(self, one.name) for one in fields(TissueLayer)})

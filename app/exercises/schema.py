"""The exercise: everything that makes one attempt like another."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Annotated

from pydantic import Field, PrivateAttr, ValidationInfo, field_validator, model_validator

from app.core.configuration import FieldText, Strict
from app.core.messages import sentence, sentence_of
from app.exercises.ablation import AblationPart
from app.exercises.drill import DrillPart
from app.exercises.guidance import (
    FadingPart,
    GuidanceMode,
    GuidancePart,
    Purpose,
    StartingDial,
)
from app.exercises.hand_bands import OF_HANDS, HandBands, check_bands, judged_by_hand
from app.exercises.locks import EVERY_LOCK, HandName, Lock
from app.exercises.parts import (
    OF_LUNG_PATHS,
    OF_OWN_PLANS,
    TELLING,
    Ct,
    EffectPart,
    LawPart,
    LayerPart,
    LayersFrom,
    NeedlePart,
    OwnPlan,
    PhantomCt,
    PlacementPart,
    PlanChoice,
    PlanPoints,
    StructurePart,
    TissueSource,
    ViewName,
)
from app.exercises.procedure import OF_PROCEDURES, ProcedurePart
from app.exercises.reading import ReadingPart
from app.exercises.touching import TouchPart, TouchTask, touch_task
from app.planning.placement import PlacedPlan, Placement
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.errors import ScoringError
from app.scoring.rows import ScoreRules
from app.scoring.score import check_names
from app.scoring.tolerance import Tolerance
from app.simulation.effects import declaration, effect_names
from app.simulation.errors import SimulationError
from app.simulation.scene import check_order


class Exercise(Strict):
    """An exercise as it stands in its YAML file; `docs/exercises.md` explains every field.

    Attributes:
        id: name for files and commands: lower-case letters, digits and hyphens.
        version: of the exercise; only attempts of one version are compared.
        level: difficulty, 1 easiest; the library is in this order.
        title: one line for people.
        description: what the student is to do.
        ct: which patient.
        plan: two points; `phantom_default`; or `{own: true}`, the student chooses the entry.
        structures: files of structures of the CT, and which of them the needle has to avoid.
        placement: how the patient lies.
        device: name or path of a device profile.
        joint: ball joint mounted on the device; empty for the profile's own.
        rig: name or path of a camera rig profile.
        assistance: dial at the start, 1 guides fully, 0 does nothing, -1 repels fully.
        fading: how that dial changes over a student's attempts; None keeps it.
        laws: name -> parameters of the force laws that act on the hand; none if empty.
        effects: name -> parameters of what is asked for; the scene compiler keeps what somebody
            consumes.
        without: name of an effect that the patient calls for -> why the exercise does without it.
        layers: tissue along the path, from the skin inwards; empty for the simulation's own.
        layers_from: `file` takes them as they are given; `ct` finds them in the CT along the path
            when the attempt begins, in place of those given.
        tissue: `layers` along the path; `field`, what the needle meets where it is, in the patient
            in three dimensions; `auto` takes layers where that makes no difference.
        needle: gauge, and length where it is not the device's own.
        target_organ: where the target lies; an effect on another organ is dropped.
        tolerances: metric -> bands and weight.
        bands: hand that moves the simulated one -> bands of its own, in place of the tolerances'.
        rules: pass mark, and when a score is void.
        purpose: practice, or an assessment; the latter guides by control scans alone unless
            `guidance.mode` says otherwise.
        guidance: what pictures the student has of the needle.
        reading: window and layout that it is read with.
        views: what is shown.
        locks: controls that stay as the exercise has them; an assessment locks all, and where
            control scans guide the assistance is locked.
        hand: what moves the simulated hand; None leaves it to the student, or is the mouse where
            it is locked.
        unsteady_hand: level by which the simulated hand is unsteady, 0 not at all; None takes the
            exercise's own level. No hand on a robot is made unsteady.
        touch: targets that the tip of a long tool has to touch one after the other; the hand then
            moves the tool's handle. None for a needle that goes to the plan's target.
        procedure: steps of the intervention beside the needle's way: local anaesthetic, samples;
            None for none.
        drill: of which exercise this is a drill, and what it practises; None for a whole one.
        seed: of everything random in the attempt.
    """

    id: Annotated[str, Field(pattern=r"^[a-z0-9]+(-[a-z0-9]+)*$", max_length=64)]
    version: Annotated[int, Field(ge=1)] = 1
    level: Annotated[int, Field(ge=1, le=9), FieldText("Level (1 easiest)")] = 1
    title: Annotated[str, Field(min_length=1, max_length=120), FieldText("Title")]
    description: Annotated[str, FieldText("Briefing")] = ""
    ct: Ct = Ct(phantom=PhantomCt())
    plan: PlanChoice = "phantom_default"
    structures: tuple[StructurePart, ...] = ()
    placement: PlacementPart = PlacementPart()
    device: Annotated[str, FieldText("Robot")] = "icube"
    joint: Annotated[str, FieldText("Ball joint, empty for the robot's own")] = ""
    rig: Annotated[str, FieldText("Cameras")] = "wide"
    assistance: Annotated[
        float,
        Field(ge=-1.0, le=1.0),
        FieldText("Dial at the start: 1 guides, 0 nothing, −1 repels"),
    ] = 0.7
    fading: FadingPart | None = None
    laws: Mapping[str, LawPart] = Field(default_factory=lambda: {"fixture": LawPart()})
    effects: Mapping[str, EffectPart] = Field(default_factory=dict)
    without: Mapping[str, str] = Field(default_factory=dict)
    layers: tuple[LayerPart, ...] = ()
    layers_from: Annotated[LayersFrom, FieldText("Where they come from")] = LayersFrom.FILE
    tissue: TissueSource = TissueSource.LAYERS
    needle: NeedlePart = NeedlePart()
    target_organ: Annotated[str, FieldText("Organ of the target")] = ""
    tolerances: Mapping[str, Tolerance] = Field(default_factory=lambda: dict(DEFAULT_TOLERANCES))
    bands: Mapping[HandName, HandBands] = Field(default_factory=dict)
    rules: ScoreRules = ScoreRules()
    purpose: Annotated[Purpose, FieldText("Purpose")] = Purpose.PRACTICE
    guidance: GuidancePart = GuidancePart()
    reading: ReadingPart = ReadingPart()
    views: Annotated[tuple[ViewName, ...], FieldText("Views")] = (
        ViewName.LIVE_OVERLAY,
        ViewName.BULLSEYE,
        ViewName.THREE_D,
    )
    locks: Annotated[tuple[Lock, ...] | None, FieldText("Locked for the student")] = None
    hand: Annotated[HandName | None, FieldText("Hand")] = None
    unsteady_hand: Annotated[
        Annotated[int, Field(ge=0, le=9)] | None, FieldText("Simulated hand")
    ] = None
    touch: TouchPart | None = None
    procedure: ProcedurePart | None = None
    drill: DrillPart | None = None
    seed: Annotated[int, Field(ge=0), FieldText("Seed of everything random")] = 1
    _is_probe: bool = PrivateAttr(default=False)

    @field_validator("effects", "laws", mode="before")
    @classmethod
    def _bare_names(cls, parts: object, info: ValidationInfo) -> object:
        """Let `breathing:` alone, or a list of names, stand for a part with its defaults."""
        if isinstance(parts, list):
            if not all(isinstance(name, str) for name in parts):
                raise ValueError(
                    sentence(
                        "a list of {info_field_name} holds names only",
                        info_field_name=info.field_name,
                    )
                )
            if len(set(parts)) < len(parts):
                raise ValueError(
                    sentence(
                        "one of the {info_field_name} is named twice",
                        info_field_name=info.field_name,
                    )
                )
            parts = dict.fromkeys(parts)
        if isinstance(parts, Mapping):
            return {name: {} if part is None else part for name, part in parts.items()}
        return parts

    @field_validator("without")
    @classmethod
    def _reasons_are_given(cls, without: Mapping[str, str]) -> Mapping[str, str]:
        for name, reason in without.items():
            if name not in effect_names():
                raise ValueError(
                    sentence(
                        "no effect is called {name!r}; there are {names}",
                        name=name,
                        names=", ".join(effect_names()),
                    )
                )
            if not reason.strip():
                raise ValueError(
                    sentence("{name} is left out without a reason: say why", name=name)
                )
        return without

    @model_validator(mode="after")
    def _nothing_is_both(self) -> Exercise:
        both = [name for name in self.without if name in self.effects]
        if "tissue_field" in self.without and self.tissue is TissueSource.FIELD:
            both.append("tissue_field")
        if both:
            raise ValueError(
                sentence(
                    "without: {effect_name} is left out, and the exercise asks for it: one of the "
                    "two",
                    effect_name=both[0],
                )
            )
        return self

    @field_validator("layers")
    @classmethod
    def _layers_can_be(cls, parts: tuple[LayerPart, ...]) -> tuple[LayerPart, ...]:
        try:
            check_order([part.layer() for part in parts])
        except SimulationError as error:
            raise ValueError(sentence_of(error)) from error
        return parts

    @field_validator("tolerances")
    @classmethod
    def _known_metrics(cls, tolerances: Mapping[str, Tolerance]) -> Mapping[str, Tolerance]:
        try:
            check_names(tolerances)
        except ScoringError as error:
            raise ValueError(sentence_of(error)) from error
        if not any(limits.weight > 0.0 for limits in tolerances.values()):
            raise ValueError(sentence("at least one metric needs a weight above 0"))
        return tolerances

    @model_validator(mode="after")
    def _risks_are_one_each(self) -> Exercise:
        names = [name for part in self.structures for name in part.risks]
        twice = {name for name in names if names.count(name) > 1}
        if twice:
            raise ValueError(
                sentence(
                    "structures: {structure_name!r} is a risk twice", structure_name=min(twice)
                )
            )
        return self

    @model_validator(mode="after")
    def _an_assessment_locks_all(self) -> Exercise:
        if self.purpose is Purpose.ASSESSMENT and self.locks is not None:
            later = Lock.MODELS  # younger than the lists that name the others
            free = [lock.value for lock in Lock if lock not in (*self.locks, later)]
            if free:
                raise ValueError(
                    sentence(
                        "locks: an assessment locks all controls, and {free} is missing: "
                        "leave locks out, or use purpose: practice",
                        free=", ".join(free),
                    )
                )
        return self

    @model_validator(mode="after")
    def _fading_can_be_followed(self) -> Exercise:
        if self.fading is not None and self.purpose is Purpose.ASSESSMENT:
            raise ValueError(
                sentence(
                    "fading: an assessment is the same for everybody: leave fading out, or use "
                    "purpose: practice"
                )
            )
        return self

    @model_validator(mode="after")
    def _plans_are_judged_where_they_are_made(self) -> Exercise:
        judged = [name for name in self.tolerances if name in OF_OWN_PLANS]
        if judged and not self.is_own_plan:
            raise ValueError(
                sentence(
                    "tolerances: {metric} is of a path that the student chooses: use plan "
                    "{{own: true}}, or leave it out",
                    metric=judged[0],
                )
            )
        return self

    @model_validator(mode="after")
    def _procedure_can_be_done(self) -> Exercise:
        for part, metrics in OF_PROCEDURES.items():
            judged = sorted(metrics & set(self.tolerances))
            if judged and getattr(self.procedure, part, None) is None:
                raise ValueError(
                    sentence(
                        "tolerances: {metric} is of a step that the exercise does not ask for: "
                        "add {part} to procedure, or leave it out",
                        metric=judged[0],
                        part=part,
                    )
                )
        if self.procedure is not None and self.tissue is not TissueSource.FIELD:
            raise ValueError(
                sentence(
                    "procedure: what a step meets is looked up in the patient: use tissue: field"
                )
            )
        if self.electrodes is not None and not isinstance(self.plan, PlanPoints):
            raise ValueError(
                sentence(
                    "procedure: electrodes lie about a path that the file names: give plan "
                    "entry_mm and target_mm"
                )
            )
        if self.procedure is not None and self.touch is not None:
            raise ValueError(sentence("procedure: a tool that touches targets takes no steps"))
        happens = self.procedure is not None and self.procedure.complications is not None
        if happens and self.guidance_mode is not GuidanceMode.CONTROL_CT:
            raise ValueError(
                sentence(
                    "procedure: complications are seen in control scans, and live pictures are of "
                    "the patient before: use guidance.mode: control_ct"
                )
            )
        return self

    @model_validator(mode="after")
    def _bands_are_of_what_is_judged(self) -> Exercise:
        check_bands(self.tolerances, self.bands)
        return self

    @model_validator(mode="after")
    def _plan_fits_ct(self) -> Exercise:
        if isinstance(self.plan, OwnPlan):
            if self.plan.target_mm is None and self.ct.phantom is None:
                raise ValueError(
                    sentence("plan {{own: true}} of a CT folder needs target_mm: [x, y, z]")
                )
            return self
        if not isinstance(self.plan, PlanPoints) and self.ct.phantom is None:
            raise ValueError(
                sentence(
                    "plan phantom_default needs ct: {{phantom: ...}}; give entry_mm and target_mm"
                )
            )
        return self

    @model_validator(mode="after")
    def _touching_can_be_followed(self) -> Exercise:
        if self.touch is None:
            return self
        if not isinstance(self.plan, PlanPoints):
            raise ValueError(
                sentence(
                    "touch: the targets lie about a path that the file names: give plan entry_mm "
                    "and target_mm"
                )
            )
        if self.guidance_mode is not GuidanceMode.LIVE:
            raise ValueError(
                sentence("touch: the targets are touched by sight: use guidance.mode: live")
            )
        return self

    def touch_task(self, placed: PlacedPlan) -> TouchTask | None:
        """Return what is to be touched on a placed plan; None where nothing is.

        Raises:
            AcusError: if targets find no room, or lie on the entry.
        """
        return touch_task(self.touch, placed, self.seed)

    @property
    def electrodes(self) -> AblationPart | None:
        """Return what is ablated; None for nothing."""
        return None if self.procedure is None else self.procedure.ablation

    @property
    def is_own_plan(self) -> bool:
        """Return whether the student chooses the entry, so that the plan is judged."""
        return isinstance(self.plan, OwnPlan)

    @property
    def asks_lung_path(self) -> bool:
        """Return whether the path report of a lung biopsy counts."""
        return bool(OF_LUNG_PATHS & self.tolerances.keys())

    @property
    def needs_field(self) -> bool:
        """Return whether it asks what lies in the patient where the needle is, or is planned to."""
        judged = self.rules.forbidden or OF_OWN_PLANS & self.tolerances.keys()
        return self.tissue is not TissueSource.LAYERS or bool(judged)

    def bands_for(self, hand: str) -> HandName | None:
        """Return whose bands a hand is judged by, as a record names it; None for the tolerances."""
        whose = OF_HANDS.get(hand)
        return whose if whose in self.bands else None

    def tolerances_for(self, hand: str) -> Mapping[str, Tolerance]:
        """Return what an attempt with a hand is judged by."""
        whose = self.bands_for(hand)
        return judged_by_hand(self.tolerances, None if whose is None else self.bands[whose])

    @property
    def guidance_mode(self) -> GuidanceMode:
        """Return what the student sees of the needle: as said, else by the purpose."""
        if self.guidance.mode is not None:
            return self.guidance.mode
        return GuidanceMode.CONTROL_CT if self.purpose is Purpose.ASSESSMENT else GuidanceMode.LIVE

    @property
    def shown_views(self) -> tuple[ViewName, ...]:
        """Views that show something: with control scans alone, none that tells of the needle."""
        if self.guidance_mode is GuidanceMode.LIVE:
            return self.views
        return tuple(view for view in self.views if view not in TELLING)

    @property
    def locked(self) -> frozenset[Lock]:
        """Controls that the student cannot change: as said; all of them in an assessment.

        Where control scans guide, the robot's help is the exercise's own; a probe gets no help.
        """
        if self.purpose is Purpose.ASSESSMENT:
            return EVERY_LOCK
        scans = self.guidance_mode is GuidanceMode.CONTROL_CT
        held = {Lock.ASSISTANCE} if scans or self.is_probe else set()
        return frozenset({*(self.locks or ()), *held, *({Lock.VIEWS} if self.is_probe else ())})

    @property
    def is_probe(self) -> bool:
        """Return whether this is the exercise as one attempt has it that is a probe: without
        help.
        """
        return self._is_probe

    @property
    def hand_level(self) -> int:
        """Return the level by which the simulated hand is unsteady; 0 is steady."""
        return self.level if self.unsteady_hand is None else self.unsteady_hand

    @property
    def holds_breath(self) -> bool:
        """Return whether the patient holds the breath on command."""
        part = self.effects.get("breathing")
        return part is not None and part.model == "on_command"

    @property
    def longest_hold(self) -> float | None:
        """Time that the patient can hold the breath [s]; None where he is not told to."""
        if not self.holds_breath:
            return None
        return declaration("breathing").checked(self.effects["breathing"].parameters)["longest"]

    def beginning_with(self, dial: StartingDial) -> Exercise:
        """Return the exercise as one attempt has it; of a probe, with nothing that tells.

        What the exercise says stays the same (`scoring.conditions.Conditions.content`): dial and
        views stand beside the score.
        """
        changes: dict[str, object] = {"assistance": dial.share}
        if dial.is_probe:
            changes["views"] = tuple(view for view in self.views if view not in TELLING)
        begun = self.model_copy(update=changes)
        begun._is_probe = dial.is_probe  # noqa: SLF001  (another of its kind)
        return begun

    def showing(self, views: Collection[ViewName]) -> Exercise:
        """Return the exercise with other views."""
        return self.model_copy(update={"views": tuple(view for view in ViewName if view in views)})

    def placed_as(self, placement: Placement) -> Exercise:
        """Return the exercise with the patient placed otherwise."""
        part = PlacementPart(orientation=placement.orientation, rotation_deg=placement.rotation_deg)
        return self.model_copy(update={"placement": part})

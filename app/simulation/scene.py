"""The scene: what stands in the simulated world, as frozen values; all that the compiler reads."""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.simulation.errors import SimulationError

SETTLING: Final = 1.0
"""Time in which an organ takes the place that a breath-hold gives it, and leaves it again [s]."""


@dataclass(frozen=True, slots=True)
class EffectRequest:
    """One effect by name; its presence in the scene is the switch.

    Attributes:
        name: file name of the effect in `simulation/effects`, without `.py`.
        parameters: SI values that replace the effect's defaults.
        model: which of the effect's ways to compute it; empty chooses the effect's first.
        organ: what the effect acts on; empty means everything. An effect on an organ that the
            target does not lie in has no consumer.
    """

    name: str
    parameters: Mapping[str, float] = dataclasses.field(default_factory=dict)
    model: str = ""
    organ: str = ""


@dataclass(frozen=True, slots=True)
class TissueLayer:
    """A slab of tissue along the path, counted from the skin.

    Along the needle a layer begins with a membrane, if `puncture_force` is above 0; pushed in by x
    it resists with `indentation_stiffness` x + `indentation_hardening` x² until it is punctured.

    Attributes:
        name: what it is, for display.
        thickness: along the path [m], 0 or more.
        side_stiffness: lateral foundation stiffness [N/m per m of needle = N/m²].
        friction: kinetic shaft friction per inserted length [N/m].
        static_friction: break-away friction per inserted length [N/m], at least `friction`.
        viscous_friction: per inserted length [N·s/m²].
        moves: share of the displacement by breathing that it goes along with, 0 to 1; None leaves
            it to `Scene.shares_moved`.
        puncture_force: at which an 18 G needle punctures the membrane [N]; grows with the outer
            diameter; 0 for none.
        toughness: fracture toughness J [J/m²]; cutting costs J times the outer diameter.
        indentation_stiffness: linear part [N/m].
        indentation_hardening: quadratic part [N/m²].
        pressing: of an 18 G tip on what it goes into, beside cutting [N]; grows with the outer
            diameter.
        relaxation_share: of the resistance to a quick indentation that relaxes, 0 to below 1.
        relaxation_time: time constant of that [s], above 0.
        rigid: bone: the needle goes no further.

    Raises:
        SimulationError: if a value is negative or not finite, a share is above 1, or a membrane has
            no stiffness.
    """

    name: str
    thickness: float
    side_stiffness: float = 20e3
    friction: float = 10.57
    static_friction: float = 18.45
    viscous_friction: float = 250.0
    puncture_force: float = 0.0
    toughness: float = 0.0
    indentation_stiffness: float = 2.0
    indentation_hardening: float = 2300.0
    relaxation_share: float = 0.0
    relaxation_time: float = 0.5
    rigid: bool = False
    pressing: float = 0.0
    moves: float | None = None

    def __post_init__(self) -> None:
        for quantity in self.__slots__[1:-1]:
            value = getattr(self, quantity)
            if not (np.isfinite(value) and value >= 0.0):
                raise SimulationError(
                    sentence(
                        "layer {name!r}: {quantity} is {setting}; give a finite value of 0 or more",
                        name=self.name,
                        quantity=quantity,
                        setting=value,
                    )
                )
        if self.moves is not None and not 0.0 <= self.moves <= 1.0:
            raise SimulationError(
                sentence(
                    "layer {name!r}: moves is {moves}; give a share from 0 to 1, or leave it out",
                    name=self.name,
                    moves=self.moves,
                )
            )
        if self.relaxation_share >= 1.0 or self.relaxation_time == 0.0:
            raise SimulationError(
                sentence(
                    "layer {name!r}: relaxation_share is {relaxation_share} and "
                    "relaxation_time {relaxation_time}; give 0 to below 1, and above 0 s",
                    name=self.name,
                    relaxation_share=self.relaxation_share,
                    relaxation_time=self.relaxation_time,
                )
            )
        if self.puncture_force > 0.0 and self.indentation(self.puncture_force) == np.inf:
            raise SimulationError(
                sentence(
                    "layer {name!r}: a membrane that is punctured at {puncture_force} N "
                    "needs an indentation_stiffness or indentation_hardening above 0",
                    name=self.name,
                    puncture_force=self.puncture_force,
                )
            )

    def indentation(self, force: float) -> float:
        """Return how far a push of `force` [N], 0 or more, indents it [m]; infinite without
        stiffness.
        """
        k, h = self.indentation_stiffness, self.indentation_hardening
        slope = k + (k * k + 4.0 * h * force) ** 0.5
        return 2.0 * force / slope if slope > 0.0 else np.inf


def check_order(layers: Sequence[TissueLayer]) -> None:
    """Check that layers can lie as they are given, from the skin inwards.

    Raises:
        SimulationError: if one lies below bone, which no needle reaches, or skin below another.
    """
    for above, below in pairwise(layers):
        if above.rigid:
            raise SimulationError(
                sentence(
                    "layer {below_name!r} lies below {above_name!r}, which is rigid: the needle "
                    "stops there; let the rigid layer be the last one",
                    below_name=below.name,
                    above_name=above.name,
                )
            )
        if below.name.strip().casefold() == "skin":
            raise SimulationError(
                sentence(
                    "layer 'skin' lies below {above_name!r}; layers are given from the skin "
                    "inwards",
                    above_name=above.name,
                )
            )


@dataclass(frozen=True, slots=True)
class Needle:
    """The needle in the scene: `length` hub to tip [m], `outer_diameter` [m] (18 G by default)."""

    length: float = 0.200
    outer_diameter: float = 1.270e-3

    def __post_init__(self) -> None:
        for quantity in ("length", "outer_diameter"):
            value = getattr(self, quantity)
            if not (np.isfinite(value) and value > 0.0):
                raise SimulationError(
                    sentence(
                        "needle {quantity} is {setting}; give a finite value above 0",
                        quantity=quantity,
                        setting=value,
                    )
                )


SKIN: Final = TissueLayer(
    name="skin",
    thickness=0.002,
    side_stiffness=50e3,
    puncture_force=1.5,
    toughness=1136.0,
    indentation_stiffness=150.0,
    indentation_hardening=30e3,
    relaxation_share=0.3,
)
"""Punctured at 1.5 N (2 to 3 N in vivo, Maurin 2004; dimples by some 5 mm), J of porcine skin cut
by a needle (table 2 of doi 10.1186/s10033-022-00767-4). Stiffness and relaxation: estimates."""

FAT: Final = TissueLayer(
    name="fat",
    thickness=0.015,
    side_stiffness=10e3,
    friction=5.0,
    static_friction=9.0,
    viscous_friction=120.0,
    toughness=80.0,
    indentation_stiffness=20.0,
    indentation_hardening=5e3,
    relaxation_share=0.3,
)
"""No membrane; J for 0.1 N with 18 G, an estimate: published are 4100 J/m² of porcine fat."""

MUSCLE: Final = TissueLayer(
    name="muscle",
    thickness=0.015,
    side_stiffness=30e3,
    friction=12.0,
    static_friction=20.0,
    puncture_force=1.0,
    toughness=240.0,
    indentation_stiffness=100.0,
    indentation_hardening=20e3,
    relaxation_share=0.3,
)
"""Its fascia is punctured at 1 N (1 to 3 N in vivo, Maurin 2004). J for 0.3 N with 18 G, an
estimate: published are 550 to 8000 J/m²."""

LIVER: Final = TissueLayer(
    name="liver",
    thickness=0.168,
    puncture_force=0.6,
    toughness=164.0,
    relaxation_share=0.3,
)
"""Capsule 0.6 N (0.3 to 1 N in vivo, Maurin 2004), bovine J 164 ± 6 J/m² over four needles (Gokgol
2012), quadratic indentation as Okamura 2004 fitted it."""

LUNG: Final = TissueLayer(
    name="lung",
    thickness=0.1,
    side_stiffness=2e3,
    friction=2.0,
    static_friction=3.5,
    viscous_friction=50.0,
    puncture_force=0.3,
    toughness=40.0,
    indentation_stiffness=20.0,
    indentation_hardening=2e3,
    relaxation_share=0.3,
)
"""Pleura, then air-filled tissue that hardly holds a needle: estimates throughout."""

BONE: Final = TissueLayer(name="bone", thickness=0.01, side_stiffness=100e3, rigid=True)
"""Where a needle stops."""

DEFAULT_LAYERS: tuple[TissueLayer, ...] = (SKIN, FAT, MUSCLE, LIVER)
"""Abdominal wall over liver; engineering defaults within the published ranges (10-50 kPa, Okamura
2004 friction). The last layer is thicker than any needle reaches."""


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Everything that the compiler needs to know.

    Attributes:
        effects: what is asked for, in any order.
        layers: tissue along the path from the fulcrum inwards.
        needle: the needle.
        R_world_patient: columns are the patient's L, P and S directions in world, shape (3, 3).
        target_organ: organ in which the target lies; empty if not known.
        joint: name of the ball joint that is mounted on the device; empty if not known.
        tissues: values of the field's tissues by code, their thickness unused; row 0 is what nobody
            labelled. Empty without a field.
        field: the bound field, which only what binds it looks into; None: tissue is in layers.
    """

    effects: tuple[EffectRequest, ...] = ()
    layers: tuple[TissueLayer, ...] = DEFAULT_LAYERS
    needle: Needle = dataclasses.field(default_factory=Needle)
    R_world_patient: FloatArray = dataclasses.field(default_factory=lambda: np.eye(3))
    target_organ: str = ""
    joint: str = ""
    tissues: tuple[TissueLayer, ...] = ()
    field: object | None = None

    def __post_init__(self) -> None:
        rotation = frozen(self.R_world_patient, (3, 3), "R_world_patient")
        if np.abs(rotation @ rotation.T - np.eye(3)).max() > 1e-6:
            raise SimulationError(
                sentence("R_world_patient {rotation} is not a rotation", rotation=rotation.tolist())
            )
        object.__setattr__(self, "R_world_patient", rotation)
        check_order(self.layers)
        if self.has_field and not self.tissues:
            raise SimulationError(
                sentence(
                    "the scene has a field of tissue and no values for it; give a row of "
                    "`tissues` for each of its codes, the first for what nobody labelled"
                )
            )
        names = [request.name for request in self.effects]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise SimulationError(
                sentence(
                    "effect {effect_name!r} stands twice in the scene; name it once",
                    effect_name=twice[0],
                )
            )

    @property
    def shares_moved(self) -> tuple[float, ...]:
        """Share of the displacement by breathing that each layer goes along with.

        As the layer says; else, where the scene breathes, 1 from the first layer on that carries
        the name of the breathing organ (of the target's, if none is named; the deepest, if that is
        not known either). The wall above stays: organs slide along it.
        """
        breathing = [request for request in self.effects if request.name == "breathing"]
        first = len(self.layers)
        if breathing:
            organ = breathing[0].organ or self.target_organ
            named = [k for k, layer in enumerate(self.layers) if organ and organ in layer.name]
            first = min(named, default=first if organ else first - 1)
        return tuple(
            float(k >= first) if layer.moves is None else layer.moves
            for k, layer in enumerate(self.layers)
        )

    @property
    def has_field(self) -> bool:
        """Return whether tissue is looked up where the needle is, instead of by depth."""
        return self.field is not None

    @property
    def met(self) -> tuple[TissueLayer, ...]:
        """Return what the needle can meet: the field's tissues by code, or layers in order."""
        return self.tissues if self.has_field else self.layers

    @property
    def membranes(self) -> tuple[TissueLayer, ...]:
        """Return the tissues that begin with a membrane."""
        return tuple(tissue for tissue in self.met if tissue.puncture_force > 0.0)

    @property
    def bones(self) -> tuple[TissueLayer, ...]:
        """Return the tissues that the needle cannot enter; of layers one at most, the last."""
        return tuple(tissue for tissue in self.met if tissue.rigid)


@dataclass(frozen=True, slots=True, eq=False)
class Binding:
    """What an effect is bound to when its parameters array is made.

    Attributes:
        scene: the scene.
        depth_slot: slot that holds the depth for effects along the needle: the true depth of a
            simulated needle, else the measured one.
        model: the chosen way to compute the effect.
    """

    scene: Scene
    depth_slot: int = sv.DEPTH
    model: str = ""

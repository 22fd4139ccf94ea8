"""Values of tissues by version: as they were first guessed, and as they were measured.

`first` are the values of `simulation.scene`, which exercises and records of before mean; they stay.
`published` stand within what was measured, each with its source or as an estimate, and belong with
the effects' models `rate`, `track`, `inserted`, `standing`, `organ`. Sources, protocols and what
excludes what: resources/published.yaml, compared by `acus study published`. "Searched" there means
stored public pages, with the words that are given.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from math import log, pi
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.simulation import scene
from app.simulation.errors import SimulationError
from app.simulation.needles import GAUGE_18
from app.simulation.scene import TissueLayer

if TYPE_CHECKING:
    from app.imaging.field import FieldTissue

HELD_AT: Final = 0.05
"""How far from the needle an organ is held [m], for the next; half the width of a liver."""

MODULUS_PER_STIFFNESS: Final = 3.0 * (log(HELD_AT / (0.5 * GAUGE_18)) - 1.0) / (4.0 * pi)
"""Young's modulus over side stiffness, 0.80 for 18 G.

A rod of radius a pushed sideways in an incompressible medium that is held at R meets, a length,
k = 4πG / (ln(R/a) - 1), and E = 3G. It is 0.59 for R of 20 mm and 0.97 for 100 mm."""

SKIN: Final = replace(
    scene.SKIN,
    puncture_force=2.78,
    indentation_stiffness=250.0,
    indentation_hardening=50e3,
    relaxation_share=0.4,
)
"""2 to 3 N in vivo (pig, 18 G, Maurin 2004), 2.75 to 2.80 N in fresh human cadavers (doi
10.1089/end.2016.0342): both hold. J of porcine skin cut by a needle, 1136 J/m² (table 2 of doi
10.1186/s10033-022-00767-4). Indentation: an estimate that dimples by some 4 mm. Relaxation: skin
relaxes (PMC7595329); the share is an estimate. Friction: an estimate, none found: searched "needle
friction force per unit length"."""

FAT: Final = replace(scene.FAT, side_stiffness=3.3e3, toughness=1000.0, relaxation_share=0.4)
"""J: published are 4100 J/m² of porcine fat (same table), which is 5.2 N for 18 G, more than skin,
fat and muscle together take in vivo (2 to 3 N, Maurin 2004); both cannot hold, and the low end is
taken, 1.3 N. Side stiffness k is E = 2.7 kPa by `MODULUS_PER_STIFFNESS`: fat and gland of the
breast are 3.04 ± 1.17 kPa in seven volunteers (suction), 3.2 ± 0.4 to 8.8 ± 1.1 kPa indented ex
vivo (Teixeira 2023), fat of the buttocks G = 0.75 kPa undeformed (ten women, magnetic resonance).
All else: estimates, none found: searched "subcutaneous fat needle insertion force"."""

MUSCLE: Final = replace(
    scene.MUSCLE,
    side_stiffness=15e3,
    puncture_force=1.5,
    toughness=550.0,
    relaxation_share=0.4,
)
"""Fascia 1 to 3 N in vivo (Maurin 2004). J: published are 550 to 8000 J/m² (same table), 0.7 to 10
N for 18 G; the low end is what 1 to 3 N in vivo leave room for. Side stiffness: an estimate, none
found: searched "normal muscle fat Young's modulus values"."""

LIVER: Final = replace(
    scene.LIVER,
    side_stiffness=4.7e3,
    pressing=0.8,
    relaxation_share=0.5,
)
"""Capsule 0.6 N (0.3 to 1 N in vivo, Maurin 2004). J 164 J/m² (Gokgol 2012; porcine in vivo 76 to
185, Azar and Hayward 2008): the difference of two insertions. With Okamura's friction (2004) that
is 0.9 N at 60 mm and 3 mm/s where he measured 1.63 N, his cutting being 0.94 N; J stands on two
sources and his total is a measurement too, so what is left, 0.8 N, is what the tip presses on
without cutting. Barnett (2015: tearing 61, spreading 18, friction 21 %) would have it the other way
round; his shares are of his specimen, cut by his needles, and friction here is 0.4 of the whole.
Side stiffness: shear waves, 4.74 ± 0.91 kPa in 115 and 5.10 ± 1.02 kPa in 502 healthy people; k is
E = 3.8 kPa by `MODULUS_PER_STIFFNESS`. Relaxation: an estimate; three decades from 0.5 s. Indented
tissue that is said to fall below half (PMC7595329) is not followed: resources/published.yaml."""

CIRRHOTIC_LIVER: Final = replace(LIVER, name="cirrhotic liver", side_stiffness=20e3)
"""Of k = 20 kPa, which is E = 16 kPa by `MODULUS_PER_STIFFNESS`: elastography calls it cirrhotic
from 9.6 kPa (best cut-off) or 12.2 kPa (most specific) on (246 patients, PMC3542745). Its other
values are those of healthy liver: estimates, none found."""

KIDNEY: Final = replace(LIVER, name="kidney", side_stiffness=6e3, puncture_force=0.6)
"""Capsule 0.3 to 1 N in vivo (Maurin 2004, kidney and liver together). All else that of liver:
porcine kidney's fitted cutting and friction differ from liver's by a third (PMC13024575)."""

LUNG: Final = replace(scene.LUNG, relaxation_share=0.4)
"""Estimates throughout, none found: searched "pleura puncture force needle lung tissue"."""

BONE: Final = scene.BONE

FIRST: Final = "first"
PUBLISHED: Final = "published"


def _table(*tissues: TissueLayer) -> Mapping[str, TissueLayer]:
    return MappingProxyType({tissue.name: tissue for tissue in tissues})


TISSUES: Final[Mapping[str, Mapping[str, TissueLayer]]] = MappingProxyType(
    {
        FIRST: _table(scene.SKIN, scene.FAT, scene.MUSCLE, scene.LIVER, scene.LUNG, scene.BONE),
        PUBLISHED: _table(SKIN, FAT, MUSCLE, LIVER, CIRRHOTIC_LIVER, KIDNEY, LUNG, BONE),
    }
)
"""Version -> name of a tissue -> its values."""

MODELS: Final[Mapping[str, Mapping[str, str]]] = MappingProxyType(
    {
        FIRST: MappingProxyType({}),
        PUBLISHED: MappingProxyType(
            {
                "puncture": "rate",
                "cutting": "track",
                "relaxation": "standing",
                "shaft_friction": "inserted",
                "bevel": "organ",
            }
        ),
    }
)
"""Version -> effect -> the model that goes with its values; others by their first."""


def tissue(name: str, version: str = PUBLISHED) -> TissueLayer:
    """Return the values of a tissue.

    Raises:
        SimulationError: for an unknown version or tissue; names what there is.
    """
    if version not in TISSUES:
        raise SimulationError(
            sentence(
                "there are no values of tissues called {version!r}; there are {tissues}",
                version=version,
                tissues=", ".join(TISSUES),
            )
        )
    table = TISSUES[version]
    if name not in table:
        raise SimulationError(
            sentence(
                "the {version} values have no tissue {name!r}; they have {table}",
                version=version,
                name=name,
                table=", ".join(table),
            )
        )
    return table[name]


_AIR: Final = TissueLayer(
    name="air",
    thickness=0.0,
    side_stiffness=0.0,
    friction=0.0,
    static_friction=0.0,
    viscous_friction=0.0,
    indentation_stiffness=0.0,
    indentation_hardening=0.0,
)
"""Air holds no needle."""

_BY_KIND: Final[Mapping[TissueKind, TissueLayer]] = MappingProxyType(
    {
        TissueKind.UNKNOWN: replace(MUSCLE, puncture_force=0.0),
        TissueKind.AIR: _AIR,
        TissueKind.LUNG: LUNG,
        TissueKind.SKIN: SKIN,
        TissueKind.FAT: FAT,
        TissueKind.MUSCLE: MUSCLE,
        TissueKind.ORGAN: LIVER,
        TissueKind.VESSEL: replace(LIVER, puncture_force=0.8, toughness=240.0),
        TissueKind.GUT: replace(LIVER, puncture_force=0.5),
        TissueKind.HEART: replace(MUSCLE, puncture_force=1.0),
        TissueKind.BONE: BONE,
    }
)
"""What nobody labelled is as muscle without its fascia, so that it is felt and stops nothing. An
organ is taken for liver; walls of vessel, gut and heart are estimates, none found."""


def tissue_values(tissues: "Iterable[FieldTissue]") -> tuple[TissueLayer, ...]:
    """Return the published values of a field's tissues by code; their thickness means nothing."""
    return tuple(replace(_values(one), name=one.words, thickness=0.0) for one in tissues)


def _values(tissue: "FieldTissue") -> TissueLayer:
    """Return the values of a tissue's kind; an organ's by the longest name that its own holds."""
    table, words = TISSUES[PUBLISHED], tissue.name.casefold()
    named = [name for name in table if name in words and not table[name].rigid]
    if tissue.kind is TissueKind.ORGAN and named:
        return table[max(named, key=len)]
    if tissue.kind is TissueKind.LUNG and words.startswith("emphysema"):
        return replace(LUNG, puncture_force=0.0)  # no pleura lies before it
    return _BY_KIND[tissue.kind]

"""What published series say of a needle that met what this one met: risks, never part of a score.

Each number stands as the abstract of its source states it. They are rates of series of patients, of
which the simulation knows little: none is the probability for this patient, and nothing is drawn by
lot.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.planning.tissues import SMALL_VESSELS
from app.scoring.met import Met
from app.scoring.pleura import (
    aerated_mm,
    crossings,
    flattest_deg,
    lung_met,
    punctures,
    target_in_lung,
)

HUO: Final = "Huo et al. 2020, Br J Radiol, PMC7362905: 36 series, 23 104 patients"
ZHU: Final = "Zhu et al. 2020, Quant Imaging Med Surg, 41160: 1090 biopsies"
ANGLE_YES: Final = "Shiekh et al. 2019, PMC6479149: 215 biopsies, p = 0.02"
ANGLE_NO: Final = "Lee and Lee 2020, Iran J Radiol e96221: 689 biopsies, p = 0.10"
AIR: Final = "systematic review, Diagn Interv Radiol 2023;29:478, dir.2022.221187"
LIVER: Final = "Thomaides-Brears et al. 2022, doi 10.1007/s10620-021-07089-w: 64 356 biopsies"
KIDNEY: Final = "Poggio et al. 2020, doi 10.2215/CJN.04710420: 118 064 biopsies"

PNEUMOTHORAX_PERCENT, DRAIN_PERCENT = 25.9, 6.9
"""Of lung biopsies by CT, pooled (HUO)."""

AGAIN_OR, DEEP_OR, EMPHYSEMA_OR, FISSURE_OR, BULLA_OR, THICK_OR = 2.43, 2.38, 3.33, 3.75, 6.13, 1.55
"""Odds ratios of pneumothorax (HUO): more than one pleural puncture against one; a lesion 3 cm deep
or more; emphysema; a fissure, a bulla crossed; needles of 18 G or thicker against thinner ones."""

SMALL_OR, FREE_OR = 2.09, 1.73
"""Odds ratios of pneumothorax (HUO): lesions smaller than 4 cm; lesions without pleural contact."""

ON_BACK_OR, UPWARDS_SUPINE_OR, UPWARDS_PRONE_OR = 3.15, 2.28, 3.20
"""Odds ratios of pneumothorax by position (HUO): supine or prone against the biopsied lung lying
down; the biopsied lung lying up against supine; the same against prone."""

DEEP_MM: Final = 30.0
"""From here on a lesion counts as deep in HUO; here by the aerated lung on the way to it."""

BLED_PERCENT, BLED_MORE_PERCENT, COUGHED_PERCENT = 31.4, 7.0, 3.0
"""Of lung biopsies: haemorrhage, one of higher grade, haemoptysis (ZHU)."""

AIR_PERCENTS: Final = (0.06, 4.8)
"""Of lung biopsies: air embolism, by series (AIR)."""

LIVER_PERCENT: Final = 0.48
"""Of liver biopsies: major bleeding (LIVER)."""

TRANSFUSED_PERCENT, HAEMATOMA_PERCENT = 1.6, 11.0
"""Of kidney biopsies: bleeding that asked for transfusion; haematomas (KIDNEY)."""


@dataclass(frozen=True, slots=True)
class PublishedRisk:
    """One sentence of published odds.

    Attributes:
        complication: `pneumothorax`, `bleeding`, `air embolism`; `not known` where none was found.
        statement: what was done, and what series say of it.
        source: who says so; empty where nobody does.
        odds_ratio: of a factor that this attempt has; None where the sentence names none.
    """

    complication: str
    statement: str
    source: str
    odds_ratio: float | None = None

    @property
    def sentence(self) -> str:
        """Say it in one line, with its source."""
        if not self.source:
            return self.statement
        return sentence("{statement} ({source})", statement=self.statement, source=self.source)

    def document(self) -> dict[str, Any]:
        """Return it as JSON-ready values."""
        return {
            "complication": self.complication,
            "statement": self.statement,
            "source": self.source,
            "odds_ratio": self.odds_ratio,
        }


def published_risks(met: Sequence[Met] | None) -> tuple[PublishedRisk, ...]:
    """Return what is published of what a needle met; nothing where nothing of it was met."""
    if not met:
        return ()
    return (*_lung(met), *_bleeding(met), *_gut(met))


def _lung(met: Sequence[Met]) -> list[PublishedRisk]:
    if not lung_met(met):
        return []
    crossed, entered, aerated = crossings(met), punctures(met), aerated_mm(met)
    found = [
        PublishedRisk(
            "pneumothorax",
            sentence(
                "Pleural crossings: {crossed}; aerated lung: {aerated:.0f} mm. In published series "
                "{percent:g} % of lung biopsies had a pneumothorax, {drain:g} % a drain.",
                crossed=crossed,
                aerated=aerated,
                percent=PNEUMOTHORAX_PERCENT,
                drain=DRAIN_PERCENT,
            ),
            HUO,
        )
    ]
    if entered > 1:
        found.append(
            PublishedRisk(
                "pneumothorax",
                sentence(
                    "Pleura punctured {entered} times: more than once, against once, has an odds "
                    "ratio of {ratio:g}.",
                    entered=entered,
                    ratio=AGAIN_OR,
                ),
                HUO,
                AGAIN_OR,
            )
        )
    if aerated >= DEEP_MM and target_in_lung(met):  # of a lesion behind the lung it says nothing
        found.append(
            PublishedRisk(
                "pneumothorax",
                sentence(
                    "A lesion {deep:g} mm deep or more, against less: odds ratio {ratio:g}.",
                    deep=DEEP_MM,
                    ratio=DEEP_OR,
                ),
                HUO,
                DEEP_OR,
            )
        )
    return [*found, *_patient(), *_angle(met)]


def _angle(met: Sequence[Met]) -> list[PublishedRisk]:
    angle = flattest_deg(met)
    if angle is None:
        return []
    return [
        PublishedRisk(
            "pneumothorax",
            sentence(
                "Pleura met {angle:.0f}° from straight in: series contradict each other about "
                "flat ones; one finds more pneumothorax, one finds none.",
                angle=angle,
            ),
            f"{ANGLE_YES}; {ANGLE_NO}",
        )
    ]


def _patient() -> list[PublishedRisk]:
    """Return what this CT does not tell of the patient, and what cannot be told from the path."""
    return [
        PublishedRisk(
            "pneumothorax",
            sentence(
                "Not known here: emphysema (odds ratio {emphysema:g}), a fissure ({fissure:g}) or "
                "a bulla ({bulla:g}) crossed; needles of 18 G or thicker ({thick:g}).",
                emphysema=EMPHYSEMA_OR,
                fissure=FISSURE_OR,
                bulla=BULLA_OR,
                thick=THICK_OR,
            ),
            HUO,
        ),
        PublishedRisk(
            "bleeding",
            sentence(
                "Of lung biopsies {bled:g} % bled into the lung, {more:g} % of a higher grade; "
                "{coughed:g} % coughed blood.",
                bled=BLED_PERCENT,
                more=BLED_MORE_PERCENT,
                coughed=COUGHED_PERCENT,
            ),
            ZHU,
        ),
        PublishedRisk(
            "air embolism",
            sentence(
                "Of lung biopsies {least:g} to {most:g} %, by series, had an air embolism.",
                least=AIR_PERCENTS[0],
                most=AIR_PERCENTS[1],
            ),
            AIR,
        ),
    ]


def _bleeding(met: Sequence[Met]) -> list[PublishedRisk]:
    vessels = [one for one in met if one.kind == TissueKind.VESSEL and one.counts]
    names = dict.fromkeys(one.words for one in vessels if one.name not in SMALL_VESSELS)
    organs = {one.name.lower() for one in met if one.kind == TissueKind.ORGAN and one.counts}
    found = [
        PublishedRisk(
            "not known",
            sentence(
                "{vessel} met: no published rate of bleeding for that vessel was found.",
                vessel=name[:1].upper() + name[1:],
            ),
            "",
        )
        for name in names
    ]
    if any("liver" in name for name in organs):
        found.append(
            PublishedRisk(
                "bleeding",
                sentence("Of liver biopsies {percent:g} % bled majorly.", percent=LIVER_PERCENT),
                LIVER,
            )
        )
    if any("kidney" in name for name in organs):
        found.append(
            PublishedRisk(
                "bleeding",
                sentence(
                    "Of kidney biopsies {haematoma:g} % had a haematoma, {transfused:g} % bled so "
                    "that blood was given.",
                    haematoma=HAEMATOMA_PERCENT,
                    transfused=TRANSFUSED_PERCENT,
                ),
                KIDNEY,
            )
        )
    return found


def _gut(met: Sequence[Met]) -> list[PublishedRisk]:
    kinds = {one.kind for one in met if one.counts}
    named = [
        sentence("Gut") if TissueKind.GUT in kinds else "",
        sentence("Heart") if TissueKind.HEART in kinds else "",
    ]
    return [
        PublishedRisk(
            "not known",
            sentence("{tissue} met: no published odds are known here.", tissue=word),
            "",
        )
        for word in named
        if word
    ]

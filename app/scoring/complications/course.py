"""How a complication runs: air in the pleural space, blood in the lung, and what the monitor shows.

How often is published; how fast and how far within minutes is not. Whatever here has no source is a
teaching estimate, chosen so that a complication can be seen and answered within one attempt. All
sizes are bounded, whatever moment is asked for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import exp, expm1
from typing import Final

from app.core.messages import sentence
from app.scoring.complications.lots import Lots
from app.scoring.odds import (
    BLED_MORE_PERCENT,
    BLED_PERCENT,
    COUGHED_PERCENT,
    DRAIN_PERCENT,
    PNEUMOTHORAX_PERCENT,
)

DRAINED: Final = DRAIN_PERCENT / PNEUMOTHORAX_PERCENT
"""Share of pneumothoraces that need a drain (Huo 2020: 6.9 of 25.9 %)."""

BLEEDS: Final = BLED_PERCENT / 100.0
"""Share of biopsies with blood in the lung; of those, of a higher grade, and with blood coughed up
(Zhu 2020: 31.4, 7.0, 3.0 %; that only who bleeds into the lung coughs blood is an assumption)."""

HIGHER: Final = BLED_MORE_PERCENT / BLED_PERCENT
COUGHS_BLOOD: Final = COUGHED_PERCENT / BLED_PERCENT

ASPIRATED: Final = 0.794
"""Share of pneumothoraces in which aspirating sufficed; of those of 30 mm and more, half (Chan
2023, PMC10392636: 102 patients)."""

ASPIRATED_LARGE: Final = 0.5
LARGE_MM: Final = 30.0

SMALL_SHARES: Final = (0.04, 0.16)
"""Largest size of a pneumothorax that needs no drain, as share of the hemithorax by volume, from
the smallest lot to the largest: a teaching estimate. So are all that follow."""

LARGE_SHARES: Final = (0.42, 0.70)
DELAY_S: Final = (5.0, 40.0)
SMALL_TIME_S, LARGE_TIME_S = 40.0, 70.0
"""Time in which 63 % of the size is reached."""

SEALED_S: Final = 10.0
"""Time in which 63 % of the air is drawn off."""

RESIDUE: Final = 0.1
"""What stays of the air that was drawn off."""

TURNED: Final = 3.0
"""With the puncture down, a leak that would need a drain grows so much slower; others stop."""

LOWER_MM: Final = (4.0, 9.0)
"""Radius of the blood about the needle's way: within 2 cm about the needle is of a lower grade
(Tai 2016, Radiology 279:287)."""

HIGHER_MM: Final = (12.0, 28.0)
BLEEDING_S: Final = (2.0, 15.0)
BLOOD_TIME_S: Final = 25.0

RESTING_SATURATION, RESTING_PULSE = 97.0, 76.0
"""Before anything happens [%, 1/min]."""

FELT_SHARE: Final = 0.12
"""A smaller pneumothorax costs no saturation."""

FALL: Final = 14.0
"""Saturation lost for each further whole hemithorax [%], and beats gained [1/min]; twice the loss
with emphysema."""

RISE: Final = 90.0
LOWEST: Final = 70.0
OXYGEN: Final = 5.0
"""Saturation that oxygen gives [%], to no more than 100 %."""

BLOOD_FALL: Final = 3.0
"""Saturation lost to blood of a higher grade [%]."""

COUGH_S: Final = 30.0
"""For so long a beginning pneumothorax makes cough."""


@dataclass(frozen=True, slots=True)
class Leak:
    """Air in the pleural space.

    Attributes:
        onset: moment at which it begins [s].
        share: of the hemithorax by volume at `since`.
        since: moment from which it runs as follows [s].
        end: share that it tends to.
        time: in which 63 % of the way there is done [s].
        needs_drain: whether it is one that grows until it is drained.
        in_vain: whether air was drawn off without effect.
    """

    onset: float
    share: float
    since: float
    end: float
    time: float
    needs_drain: bool
    in_vain: bool = False

    @classmethod
    def of(cls, lots: Lots, onset: float) -> Leak:
        """Return that of an attempt which begins at `onset` [s]."""
        drain = lots.drain < DRAINED
        low, high = LARGE_SHARES if drain else SMALL_SHARES
        time = LARGE_TIME_S if drain else SMALL_TIME_S
        return cls(onset, 0.0, onset, low + lots.size * (high - low), time, drain)

    def at(self, time: float) -> float:
        """Return its share of the hemithorax at a moment [s], 0 to 1; 0 before it begins."""
        if not time > self.since:
            return self.share if time >= self.onset else 0.0
        left = exp(-min(700.0, (time - self.since) / self.time))
        return min(1.0, max(0.0, self.end + (self.share - self.end) * left))

    def drained(self, now: float) -> Leak:
        """Return it with a drain from `now` [s] on."""
        return self._towards(now, RESIDUE * self.at(now), SEALED_S)

    def aspirated(self, now: float, rim_mm: float, lot: float) -> Leak:
        """Return it after air was drawn off at `now` [s]; of `rim_mm` then.

        `lot` decides whether it helps: air that does not stay away was drawn off in vain.
        """
        odds = ASPIRATED_LARGE if rim_mm >= LARGE_MM else ASPIRATED
        if lot >= odds:
            return replace(self, in_vain=True)
        return self._towards(now, RESIDUE * self.at(now), SEALED_S)

    def turned(self, now: float) -> Leak:
        """Return it with the puncture down from `now` [s] on."""
        if self.needs_drain:
            return self._towards(now, self.end, self.time * TURNED)
        return self._towards(now, min(self.end, self.at(now)), self.time)

    def _towards(self, now: float, end: float, time: float) -> Leak:
        return replace(self, share=self.at(now), since=now, end=end, time=time)


@dataclass(frozen=True, slots=True)
class Bleeding:
    """Blood in the lung about the needle's way.

    Attributes:
        onset: moment at which it begins [s].
        radius_mm: that it tends to, about the way.
        higher: whether it is of a higher grade.
        coughs: whether blood is coughed.
    """

    onset: float
    radius_mm: float
    higher: bool
    coughs: bool

    @classmethod
    def of(cls, lots: Lots, onset: float) -> Bleeding:
        """Return that of an attempt which begins at `onset` [s]."""
        higher = lots.grade < HIGHER
        low, high = HIGHER_MM if higher else LOWER_MM
        radius = low + lots.spread * (high - low)
        return cls(onset, radius, higher, lots.cough < COUGHS_BLOOD)

    def at(self, time: float) -> float:
        """Return its radius at a moment [mm]; 0 before it begins."""
        if not time > self.onset:
            return 0.0
        return self.radius_mm * -expm1(-min(700.0, (time - self.onset) / BLOOD_TIME_S))


@dataclass(frozen=True, slots=True)
class Vitals:
    """What monitor and patient tell.

    Attributes:
        saturation: of the blood with oxygen [%].
        pulse: [1/min].
        pain: 0 to 10.
        coughs: whether the patient coughs.
        coughs_blood: whether there is blood in it.
    """

    saturation: int = round(RESTING_SATURATION)
    pulse: int = round(RESTING_PULSE)
    pain: int = 0
    coughs: bool = False
    coughs_blood: bool = False

    @property
    def has_symptoms(self) -> bool:
        """Return whether the patient is short of air: a saturation below 92 %."""
        return self.saturation < SYMPTOMS_BELOW

    @property
    def sentence(self) -> str:
        """Say it in one line."""
        cough = sentence("no cough")
        if self.coughs_blood:
            cough = sentence("coughs blood")
        elif self.coughs:
            cough = sentence("coughs")
        return sentence(
            "Saturation {saturation} %, pulse {pulse}/min, pain {pain} of 10, {cough}",
            saturation=self.saturation,
            pulse=self.pulse,
            pain=self.pain,
            cough=cough,
        )


SYMPTOMS_BELOW: Final = 92
"""Saturation below which a patient counts as short of air [%]: a teaching estimate."""


def vitals(
    leak: Leak | None,
    bleeding: Bleeding | None,
    now: float,
    emphysema: bool = False,
    oxygen: bool = False,
) -> Vitals:
    """Return what monitor and patient tell at a moment [s]: teaching estimates throughout."""
    share = 0.0 if leak is None else leak.at(now)
    felt = max(0.0, share - FELT_SHARE)
    lost = FALL * felt * (2.0 if emphysema else 1.0)
    coughs, pain = False, 0.0
    if leak is not None and now >= leak.onset:
        since = now - leak.onset
        coughs = since < COUGH_S
        pain = 2.0 + 3.0 * exp(-min(700.0, since / COUGH_S)) + 4.0 * share
    coughs_blood = False
    if bleeding is not None and now >= bleeding.onset:
        grown = bleeding.at(now) / bleeding.radius_mm
        lost += BLOOD_FALL * grown * bleeding.higher
        coughs_blood = bleeding.coughs
    saturation = RESTING_SATURATION - lost + (OXYGEN if oxygen else 0.0)
    return Vitals(
        round(min(100.0, max(LOWEST, saturation))),
        round(RESTING_PULSE + RISE * felt),
        round(min(10.0, pain)),
        coughs or coughs_blood,
        coughs_blood,
    )

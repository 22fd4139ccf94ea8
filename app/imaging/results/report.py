"""Structured report (PS3.16 TID 1500): what was planned, where the tip ended, and what that is.

Codes are SNOMED CT's, DICOM's and UCUM's where they have one; all others are of the private scheme
`99ACUS`, whose values are the names of the metrics.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from app.imaging.results.attempt_facts import AttemptFacts, MeasuredValue

SCHEME: Final = "99ACUS"

_NAMES: Final = {
    "score_total": ("246262008", "SCT", "Score"),
    "total_time": ("762636008", "SCT", "Duration"),
    "path_length": ("410668003", "SCT", "Length"),
}
"""Metrics that a public scheme has a code for."""

_UNITS: Final = {
    "mm": ("mm", "mm"),
    "°": ("deg", "degrees"),
    "s": ("s", "s"),
    "N": ("N", "N"),
    "%": ("%", "%"),
    "mm²": ("mm2", "mm2"),
    "": ("1", "no units"),
}
"""Units of metrics in UCUM; another one is a count, `{unit}`."""


def report(highdicom: Any, headers: Sequence[Any], attempt: AttemptFacts) -> Any:
    """Return the report on an attempt; of the CT it names the slices as evidence."""
    sr, series = highdicom.sr, headers[0].SeriesInstanceUID
    frame = str(headers[0].FrameOfReferenceUID)

    def code(value: str, scheme: str, meaning: str) -> Any:
        return sr.CodedConcept(value, scheme, meaning)

    def private(value: str, meaning: str) -> Any:
        return code(value, SCHEME, meaning[:64])

    def measurement(value: MeasuredValue) -> Any:
        name = _NAMES.get(value.name)
        unit, words = _UNITS.get(value.unit, (f"{{{value.unit}}}", value.unit))
        return sr.Measurement(
            name=code(*name) if name else private(value.name, value.label),
            value=float(f"{value.value:.9g}"),
            unit=code(unit, "UCUM", words),
        )

    def tracked(name: str) -> Any:
        return sr.TrackingIdentifier(uid=attempt.uid("tracking", name, series), identifier=name)

    groups = [
        sr.PlanarROIMeasurementsAndQualitativeEvaluations(
            tracking_identifier=tracked(name),
            referenced_region=sr.ImageRegion3D("POINT", np.array([point]), frame),
            finding_type=private(name.lower(), f"{name} of the needle path"),
        )
        for name, point in attempt.points.items()
    ]
    verdict = []
    if attempt.passed is not None:
        meant = private("passed", "Passed") if attempt.passed else private("failed", "Failed")
        verdict = [sr.QualitativeEvaluation(private("verdict", "Verdict"), meant)]
    whole = sr.MeasurementsAndQualitativeEvaluations(
        tracking_identifier=tracked("Attempt"),
        finding_type=private("attempt", "Training attempt at a needle insertion"),
        measurements=[measurement(one) for one in attempt.measured] or None,
        qualitative_evaluations=verdict or None,
    )
    observer = sr.ObserverContext(
        code("121007", "DCM", "Device"),
        sr.DeviceObserverIdentifyingAttributes(
            uid=attempt.uid("device"), name="Acus", manufacturer_name="Acus", model_name="trainer"
        ),
    )
    content = sr.MeasurementReport(
        observation_context=sr.ObservationContext(observer_device_context=observer),
        procedure_reported=private("simulated-insertion", "Simulated CT-guided needle insertion"),
        imaging_measurements=[*groups, whole],
    )
    found = sr.Comprehensive3DSR(
        evidence=list(headers),
        content=content[0],
        series_instance_uid=attempt.uid("SR series", series),
        series_number=303,
        sop_instance_uid=attempt.uid("SR", series),
        instance_number=1,
        manufacturer="Acus",
        is_complete=True,
    )
    found.CodingSchemeIdentificationSequence = [_scheme()]
    return found


def _scheme() -> Any:
    from pydicom.dataset import Dataset

    item = Dataset()
    item.CodingSchemeDesignator = SCHEME
    item.CodingSchemeName = "Metrics of the Acus trainer"
    item.CodingSchemeResponsibleOrganization = "Acus"
    return item

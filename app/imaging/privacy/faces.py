"""Faces: a head scan can be rendered to a likeness; that is said, never quietly dealt with."""

import re

from pydicom.dataset import Dataset

_HEAD = re.compile(
    "HEAD|HEADNECK|NECK|BRAIN|SKULL|FACE|EAR|EYE|IAC|JAW|MANDIBLE|MAXILLA|ORBIT|SINUS|CSPINE"
    "|CAROTID|NECKCHEST|NECKCHESTABDOMEN|NECKCHESTABDPELV|WHOLEBODY"
)
_TEXTS = ("StudyDescription", "SeriesDescription", "ProtocolName")
_SPOKEN = re.compile(
    r"\b(head|neck|brain|skull|face|facial|sinus|orbit|crani|cereb|kopf|sch(ae|ä)del|hals|gesicht"
    r"|nnh|t[eê]te|cr[aâ]n|cabeza|testa|hoofd)",
    re.IGNORECASE,
)


def warning(dataset: Dataset) -> str:
    """Return what to say about a face in these slices; empty where none is to be expected."""
    part = str(dataset.get("BodyPartExamined", "") or "").strip().upper()
    if _HEAD.fullmatch(part):
        return (
            f"a face may be recognisable in the 3D view (body part {part}): nothing was removed "
            "from the pictures; keep this CT where patients' pictures may be kept"
        )
    recognisable = str(dataset.get("RecognizableVisualFeatures", "") or "").strip().upper()
    if recognisable == "YES" or any(_SPOKEN.search(str(dataset.get(k, "") or "")) for k in _TEXTS):
        return (
            "the files' own texts speak of a head or neck: a face may be recognisable in the 3D "
            "view; nothing was removed from the pictures"
        )
    if not part:
        return (
            "the files do not say which body part they show: if it is the head, a face may be "
            "recognisable in the 3D view"
        )
    return ""

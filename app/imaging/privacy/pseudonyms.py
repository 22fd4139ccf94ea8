"""Names that stand for patients and studies and tell nothing of them."""

import re
from functools import lru_cache

from app.imaging.privacy.key import derived, installation_key

_OWN = re.compile(r"CT-[0-9A-F]{8}")


def pseudonym(patient_id: str, study_uid: str, study_id: str = "") -> str:
    """Name of a patient's study, `CT-` and eight hexadecimal digits; the same at every reading.

    Args:
        patient_id: PatientID.
        study_uid: StudyInstanceUID.
        study_id: StudyID; in a file that Acus itself de-identified it is the pseudonym.

    Raises:
        KeyDamagedError: if this installation has no usable key.
    """
    if _OWN.fullmatch(study_id):
        return study_id
    return _pseudonym(installation_key(), patient_id, study_uid)


@lru_cache(maxsize=1)
def _pseudonym(key: bytes, patient_id: str, study_uid: str) -> str:
    """Return the name under this key; the next header is mostly of the same study."""
    digest = derived(key, "pseudonym", patient_id, study_uid)
    return f"CT-{digest.hex()[:8].upper()}"


def patient_pseudonym(key: bytes, patient_id: str, study_uid: str) -> str:
    """Name of a patient over all studies; of one study where the patient has no identifier."""
    digest = derived(key, "patient", patient_id or f"study {study_uid}")
    return f"P-{digest.hex()[:8].upper()}"

"""Codes of DICOM segments: SNOMED CT, PS3.16 CID 7150, 7159 and below."""

from app.imaging.structures.structure import Kind

CODES = {
    Kind.RISK: (("123037004", "Anatomical structure"), ("113343008", "Organ")),
    Kind.VESSEL: (("123037004", "Anatomical structure"), ("59820001", "Blood vessel")),
    Kind.BONE: (("123037004", "Anatomical structure"), ("272673000", "Bone")),
    Kind.TARGET: (("49755003", "Morphologically abnormal structure"), ("52988006", "Lesion")),
    Kind.OTHER: (("85756007", "Tissue"), ("85756007", "Tissue")),
}
"""Category and type of a segment by kind."""

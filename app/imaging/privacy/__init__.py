"""De-identification of CT files at import: DICOM PS3.15, Basic Profile, and less than it allows."""

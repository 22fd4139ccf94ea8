"""Cases, peer and judgement of the study of reading DICOM."""

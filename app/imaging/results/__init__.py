"""A finished attempt as DICOM objects that refer to its CT: SEG, RTSTRUCT, GSPS and SR.

Written in the worker process, since each repeats what foreign files say. Only a CT that was
de-identified is referred to, or the built-in patient's: patient and study of the objects are its
own. Nobody who practised is named. UIDs are made of the attempt's, so that the same attempt written
twice is the same objects, and an archive keeps one.

The door: `AttemptFacts`, `write_results`.
"""

from app.imaging.results.attempt_facts import AttemptFacts, MeasuredValue
from app.imaging.results.errors import ResultsError
from app.imaging.results.files import write_results

__all__ = ["AttemptFacts", "MeasuredValue", "ResultsError", "write_results"]

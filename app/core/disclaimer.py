"""The one sentence that stands on the start page, the CT views, reports, exports and README."""

from typing import Final

DISCLAIMER: Final = "Training only. Not a medical device; not for diagnosis or patient care."
"""English original; views translate it."""

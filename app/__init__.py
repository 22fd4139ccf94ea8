"""Acus: a desktop trainer for CT-guided needle insertion. Training only, not a medical device."""

import os
from typing import Final

__version__ = "0.1.0"

MOST_PIXELS: Final = 1 << 26
"""No picture of a camera has more, 8192 x 8192: 200 MB in colour; cameras for this have 2 to 12
million pixels, phones up to 50."""

# OpenCV asks once, when it is loaded, and then reads a file's header before it takes any memory.
os.environ["OPENCV_IO_MAX_IMAGE_PIXELS"] = str(MOST_PIXELS)

"""CT in: series reading, volumes, slicing, windowing and the phantom patient.

Other packages are kept quiet here: what they log and warn of a file quotes its header, patients'
names. What is wrong with a file is said by this room itself, in words that quote nothing. In the
worker process nothing is logged at all; this is for the program, whatever it logs otherwise.
"""

import logging
import warnings

PACKAGES = (
    "pydicom",
    "pynetdicom",
    "highdicom",
    "nibabel",
    "nrrd",
    "pylibjpeg",
    "openjpeg",
    "_openjpeg",
    "jpeg_ls",
)
_WITH_HANDLERS = ("nibabel.global",)  # nibabel gives it one of its own, which writes to stderr


def silence() -> None:
    """Let nothing of these packages reach a log or the terminal; at any time, also before them."""
    for name in PACKAGES:
        log = logging.getLogger(name)
        log.propagate = False
        log.setLevel(logging.CRITICAL + 1)
        log.addHandler(logging.NullHandler())
    for name in _WITH_HANDLERS:
        logging.getLogger(name).disabled = True
    warnings.filterwarnings("ignore", module=rf"({'|'.join(PACKAGES)})(\.|$)")


silence()

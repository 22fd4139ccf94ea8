"""Entry of the child: `python -m app.imaging.worker WHERE`, which says where its connection is."""

import sys

from app.imaging.worker.child import main

main(sys.argv[1])

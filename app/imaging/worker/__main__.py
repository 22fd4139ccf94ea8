"""Entry of the child: `python -m app.imaging.worker FD`, FD being its end of a socket pair."""

import sys

from app.imaging.worker.child import main

main(int(sys.argv[1]))

"""Many attempts on many processors: stored ones scored anew, and sweeps in virtual time.

Work is cut into *parts* whose bounds follow from the input alone. A finished part is a file, named
by the digest of all that decides about its rows, so that it is not done again, whoever did it; the
table is made of the parts in the order of the input, and is the same to the bit by any number of
workers. What does the parts is a *crew*: this process, processes of this computer, or the workers
of a Dask scheduler (extra `cohort`). Without this folder the program has one command less.

The door: `rescore`, `sweep`, `SweepGrid`, and `crew_of`, which says who works.
"""

from app.cohort.cost import AttemptCost
from app.cohort.crew import crew_of
from app.cohort.errors import CohortError
from app.cohort.grid import SweepGrid
from app.cohort.rescoring import rescore
from app.cohort.running import Crew, RunOutcome
from app.cohort.sweeping import sweep

__all__ = [
    "AttemptCost",
    "CohortError",
    "Crew",
    "RunOutcome",
    "SweepGrid",
    "crew_of",
    "rescore",
    "sweep",
]

"""Research studies with Acus: design, allocation, bundle for publication, power, questionnaires.

A study is a YAML file until it begins; then its list of allocations is sealed and a ledger says
what happens. What leaves is one bundle, which anybody can check without this station. (Studies of
the program's own accuracy are another room.)

The door: `ResearchDesign` and `read_design`, `begin` and `find_study`.
"""

from app.research.beginning import begin
from app.research.design import ResearchDesign, design_problems, read_design
from app.research.errors import ResearchError
from app.research.research_study import ResearchStudy, find_study, studies_here

__all__ = [
    "ResearchDesign",
    "ResearchError",
    "ResearchStudy",
    "begin",
    "design_problems",
    "find_study",
    "read_design",
    "studies_here",
]

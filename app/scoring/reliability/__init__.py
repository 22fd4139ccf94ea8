"""How far scores can be relied on: agreement, variance components, what more attempts would give.

The door of this folder: `icc` (Shrout and Fleiss), `components` and `reml` (variance components of
students x exercises x occasions), `dependability` (G and D study), `items` (difficulty,
discrimination, standard errors). All of them take points as arrays and know nothing of attempts.
"""

from app.scoring.reliability.components import ScoreCube, VarianceComponents, variance_components
from app.scoring.reliability.dependability import (
    DecisionStudy,
    ItemStatistics,
    item_statistics,
    within_student_sd,
)
from app.scoring.reliability.icc import Agreement, intraclass

__all__ = [
    "Agreement",
    "DecisionStudy",
    "ItemStatistics",
    "ScoreCube",
    "VarianceComponents",
    "intraclass",
    "item_statistics",
    "variance_components",
    "within_student_sd",
]

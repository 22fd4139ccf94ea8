"""Competence at a skill with stated errors: LC-CUSUM until it is shown, then CUSUM for relapse."""

from app.scoring.competence.cusum import CompetenceError as CompetenceError
from app.scoring.competence.design import Design as Design
from app.scoring.competence.design import design as design
from app.scoring.competence.following import Competence as Competence
from app.scoring.competence.following import CompetenceState as CompetenceState
from app.scoring.competence.following import competence as competence
from app.scoring.competence.following import competence_words as competence_words
from app.scoring.competence.forecast import Forecast as Forecast
from app.scoring.competence.rule import RULE as RULE
from app.scoring.competence.rule import CompetenceRule as CompetenceRule

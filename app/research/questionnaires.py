"""Questionnaires as YAML: items, a scale, and scores made by a rule; NASA-TLX, SUS, own ones."""

from __future__ import annotations

import csv
import io
import math
from collections import Counter
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Annotated, Final

from pydantic import Field, model_validator

from app.core import paths
from app.core.configuration import Strict, load
from app.core.errors import AcusError, ConfigurationError
from app.core.files import read_at_most
from app.core.messages import sentence
from app.research.design import Name
from app.research.errors import ResearchError

WEIGHT: Final = "_weight"
"""End of the name of an item's weight among the answers."""

ItemName = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$", max_length=40)]


class Item(Strict):
    """One question.

    Attributes:
        name: of the item.
        wording: as it is asked.
        reversed: whether a high answer speaks against what is asked for.
        ends: what the least and the largest answer mean, where they are the item's own.
    """

    name: ItemName
    wording: Annotated[str, Field(min_length=1)]
    reversed: bool = False
    ends: tuple[str, str] | None = None


class ItemWeights(Strict):
    """ItemWeights that the student gives to the items.

    Attributes:
        total: what they add up to.
        most: of one.
    """

    total: Annotated[int, Field(ge=1)]
    most: Annotated[int, Field(ge=1)]


class ScoreRule(Strict):
    """How a score is made: the mean of answers, stretched to its own range.

    Attributes:
        name: of the score.
        lowest: where all answers are at the low end.
        highest: where all are at the high end.
        items: names; all without any.
        weighted: by the student's weights.
    """

    name: ItemName
    lowest: float
    highest: float
    items: tuple[ItemName, ...] = ()
    weighted: bool = False


class Questionnaire(Strict):
    """A questionnaire.

    Attributes:
        id: of it.
        version: of its wording.
        title: for people.
        source: where it was published.
        low: least answer.
        high: largest answer.
        ends: what the two mean.
        items: in order.
        weights: that the student gives; None where there are none.
        scores: made of the answers.
    """

    id: Name
    version: Annotated[str, Field(min_length=1, max_length=20)]
    title: Annotated[str, Field(min_length=1, max_length=120)]
    source: str = ""
    low: float
    high: float
    ends: tuple[str, str] = ("", "")
    items: Annotated[tuple[Item, ...], Field(min_length=1, max_length=200)]
    weights: ItemWeights | None = None
    scores: tuple[ScoreRule, ...] = ()

    @model_validator(mode="after")
    def _fits_together(self) -> Questionnaire:
        if self.high <= self.low:
            raise ValueError(sentence("high: it must be greater than low"))
        names = [item.name for item in self.items]
        counts = Counter((*names, *(rule.name for rule in self.scores)))
        twice = [name for name, count in counts.items() if count > 1]
        if twice:
            raise ValueError(sentence("items: {name!r} stands there twice", name=twice[0]))
        for rule in self.scores:
            unknown = [name for name in rule.items if name not in names]
            if unknown:
                raise ValueError(
                    sentence(
                        "scores: {score} has no item {name!r}; there are {names}",
                        score=rule.name,
                        name=unknown[0],
                        names=", ".join(names),
                    )
                )
            if rule.weighted and self.weights is None:
                raise ValueError(sentence("scores: {score} needs weights", score=rule.name))
        return self

    def scored(self, answers: Mapping[str, float]) -> dict[str, float]:
        """Return the scores; those that need weights only where these were given.

        Args:
            answers: by item, and weights by item with `_weight` at the end.

        Raises:
            ResearchError: if an answer is missing, unknown or out of its range.
        """
        weights = self._checked(answers)
        found = {}
        for rule in self.scores:
            if rule.weighted and not weights:
                continue
            items = [one for one in self.items if not rule.items or one.name in rule.items]
            shares = {one.name: weights[one.name] if rule.weighted else 1.0 for one in items}
            if not sum(shares.values()):
                continue
            values = [shares[one.name] * self._straight(one, answers[one.name]) for one in items]
            mean = math.fsum(values) / sum(shares.values())
            stretch = (rule.highest - rule.lowest) / (self.high - self.low)
            found[rule.name] = rule.lowest + stretch * (mean - self.low)
        return found

    def _straight(self, item: Item, answer: float) -> float:
        return self.low + self.high - answer if item.reversed else answer

    def _checked(self, answers: Mapping[str, float]) -> dict[str, float]:
        names = [item.name for item in self.items]
        missing = [name for name in names if name not in answers]
        if missing:
            raise ResearchError(
                sentence(
                    "{questionnaire}: no answer to {items}",
                    questionnaire=self.id,
                    items=", ".join(missing),
                )
            )
        weights = {n.removesuffix(WEIGHT): v for n, v in answers.items() if n not in names}
        unknown = [n for n in answers if n not in names and n.removesuffix(WEIGHT) not in names]
        if unknown or (weights and self.weights is None):
            raise ResearchError(
                sentence(
                    "{questionnaire} has no item {question!r}; it has {items}",
                    questionnaire=self.id,
                    question=(unknown or [next(iter(weights)) + WEIGHT])[0],
                    items=", ".join(names),
                )
            )
        for name in names:
            if not self.low <= answers[name] <= self.high:
                raise ResearchError(
                    sentence(
                        "{questionnaire}: {question} is {answer:g}; it must be {low:g} to {high:g}",
                        questionnaire=self.id,
                        question=name,
                        answer=answers[name],
                        low=self.low,
                        high=self.high,
                    )
                )
        if weights and self.weights is not None:
            self._check_weights(weights, self.weights, names)
        return weights

    def _check_weights(
        self, weights: Mapping[str, float], rule: ItemWeights, names: list[str]
    ) -> None:
        whole = all(w == int(w) and 0 <= w <= rule.most for w in weights.values())
        if set(weights) != set(names) or not whole or sum(weights.values()) != rule.total:
            raise ResearchError(
                sentence(
                    "{questionnaire}: weights are whole numbers from 0 to {most}, one for each "
                    "item, {total} in all",
                    questionnaire=self.id,
                    most=rule.most,
                    total=rule.total,
                )
            )


def questionnaires_folders() -> tuple[Path, Path]:
    """Return where questionnaires lie: the shipped folder and the user's."""
    shipped = paths.resources() / "research" / "questionnaires"
    return shipped, paths.data() / "questionnaires"


def questionnaire_titles() -> dict[str, str]:
    """Return the titles of the questionnaires that are here, by id; a broken one has its id."""
    titles: dict[str, str] = {}
    for path in (path for place in questionnaires_folders() for path in place.glob("*.yaml")):
        titles[path.stem] = path.stem
        with suppress(AcusError):
            titles[path.stem] = load(path, Questionnaire).title
    return dict(sorted(titles.items(), key=lambda pair: pair[1].casefold()))


def find_questionnaire(name: str) -> Questionnaire:
    """Return a questionnaire by its id, or by the path of its file.

    Raises:
        ResearchError: if there is none; names those that there are.
        ConfigurationError: if its file cannot be used.
    """
    if name.endswith((".yaml", ".yml")):
        return load(Path(name), Questionnaire)
    places = questionnaires_folders()
    files = {path.stem: path for place in places for path in sorted(place.glob("*.yaml"))}
    if name not in files:
        raise ResearchError(
            sentence(
                "no questionnaire {name!r}; there are {names}, or give the path of a .yaml file",
                name=name,
                names=", ".join(files),
            )
        )
    found = load(files[name], Questionnaire)
    if found.id != name:
        raise ConfigurationError(
            sentence("{path}: id: {id!r} must be the file's name", path=files[name], id=found.id)
        )
    return found


def read_answers(path: Path) -> list[dict[str, str]]:
    """Read answers from a CSV whose first line names its columns, with commas or semicolons.

    Raises:
        ResearchError: if it cannot be read, or has no row.
    """
    try:
        text = read_at_most(path).decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ResearchError(
            sentence(
                "cannot read {path}: {reason}",
                path=path,
                reason=getattr(error, "strerror", None) or error,
            )
        ) from error
    first = text.partition("\n")[0]
    separator = ";" if first.count(";") > first.count(",") else ","
    try:
        rows = list(csv.DictReader(io.StringIO(text, newline=""), delimiter=separator, restval=""))
    except csv.Error as error:
        raise ResearchError(
            sentence("cannot read {path}: {reason}", path=path, reason=error)
        ) from error
    found = [{str(k).strip(): str(v or "").strip() for k, v in row.items() if k} for row in rows]
    if not found:
        raise ResearchError(sentence("{path} has no row of answers", path=path))
    return found


def numbers_of(row: Mapping[str, str]) -> dict[str, float]:
    """Return the answers of a row as numbers; empty cells are left out.

    Raises:
        ResearchError: if one is no number.
    """
    found = {}
    for name, cell in row.items():
        try:
            if cell:
                found[name] = float(cell.replace(",", "."))
                if not math.isfinite(found[name]):
                    raise ValueError
        except ValueError as error:
            raise ResearchError(
                sentence("{question}: {cell!r} is no number", question=name, cell=cell)
            ) from error
    return found

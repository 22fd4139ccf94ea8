"""The study of the tissue field: its reference, how boundaries are matched, what it must see."""

from functools import lru_cache

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.imaging.field.making import make
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.simulation.scene import TissueLayer
from app.studies import field_errors, field_paths, tissue_field
from app.studies.field_paths import STEP_MM, NeedleFeel
from app.studies.references.recipe_points import RecipePoints

SOFT = TissueLayer("soft", 0.0)
TISSUES = (SOFT, SOFT, TissueLayer("organ", 0.0, puncture_force=0.6))


@lru_cache(maxsize=1)
def recipe() -> RecipePoints:
    return RecipePoints(1001)


def felt(codes: list[int], force: float = 0.0) -> NeedleFeel:
    count = len(codes)
    return NeedleFeel(np.array(codes), np.full(count, force), np.zeros(count), np.zeros(count))


@pytest.mark.long("statistics")
def test_the_reference_has_each_organ_where_the_anatomy_says() -> None:
    from app.imaging.field.from_recipe import TABLE

    known = anatomy(1001)
    names = {
        name: TABLE[int(recipe().codes_at(np.array(point))[0])].words
        for name, point in known.organs.items()
    }
    assert names["liver"] == "liver"
    assert names["left kidney"] == names["right kidney"] == "kidney"
    assert names["spleen"] == "spleen"
    assert names["aorta"] == "artery"
    assert names["left lung"] == names["right lung"] == "lung"
    assert names["lung nodule"] == "lung nodule"
    assert names["spine"] == "bone"
    assert TABLE[int(recipe().codes_at(np.array(known.lesion_mm))[0])].words == "lesion"


@pytest.mark.long("statistics")
def test_the_field_has_what_the_reference_has_but_at_boundaries() -> None:
    entry = np.array(anatomy(1001).entry_mm)
    field = make(load_ct(phantom_series(1001)), (), entry, 60.0)
    points = entry + np.random.default_rng(2).uniform(-40.0, 40.0, (20_000, 3))
    codes = field.codes_at(points)
    there = codes > 0
    assert np.mean(codes[there] == recipe().codes_at(points)[there]) > 0.99


def test_boundaries_are_matched_one_to_one_and_what_is_left_is_told() -> None:
    reference = felt([0] * 100 + [1] * 100 + [2] * 100 + [1] * 3 + [2] * 97)
    other = felt([0] * 104 + [1] * 94 + [2] * 202, 0.5)
    errors = field_errors.compare(reference, other, TISSUES)
    np.testing.assert_allclose(errors.places, [4 * STEP_MM, 2 * STEP_MM])
    assert errors.is_membrane.tolist() == [False, True]
    assert [k for k, _ in errors.missing] == [300, 303]
    assert errors.unknown == errors.lost == 0
    assert (errors.force == 0.5).all()
    assert len(errors.force) == 400 - 41 * 2 - 44  # a millimetre about each boundary


def test_a_path_begins_outside_and_goes_round_an_arc_of_its_curvature() -> None:
    entry, target = np.zeros(3), np.array([0.0, 80.0, 0.0])
    paths = field_paths.random_paths(entry, target, 20, 3)
    for path in paths:
        steps = np.linalg.norm(np.diff(path.points, axis=0), axis=1)
        np.testing.assert_allclose(steps, STEP_MM * 1e-3, rtol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(path.ways, axis=1), 1.0)
        turned = np.arccos(np.clip(path.ways[0] @ path.ways[-1], -1.0, 1.0))
        assert turned <= field_paths.MOST_BENT * 0.1
        assert np.linalg.norm(path.breath, axis=1).max() <= field_paths.MOST_BREATH_MM * 1e-3


@pytest.mark.long("statistics")
def test_bent_needles_in_a_patient_who_breathes_meet_what_the_recipe_has() -> None:
    def silent(_: float, __: str) -> None: ...

    errors, missing, _ = tissue_field._bent(tissue_field._built_in(6), 5, silent)
    places = np.concatenate([one.places for one in errors])
    alike = [one for one in errors if not one.lost]  # a vessel that is just grazed is felt or not
    force: FloatArray = np.concatenate([one.force for one in alike])
    assert len(alike) >= 4
    assert len(places) > 25
    assert np.percentile(places, 95.0) <= 0.3
    assert np.sqrt(np.mean(force**2)) < 0.02
    assert sum(one.unknown for one in errors) <= 2  # a wall that breathes along is met once
    assert len(missing) <= 2


@pytest.mark.parametrize(
    ("thickness", "angle", "reason"), [(0.2, 10.0, "thin"), (2.0, 80.0, "grazed")]
)
def test_what_is_missing_says_why_it_is_hard(thickness: float, angle: float, reason: str) -> None:
    one = field_errors.Missing("patient 1", 0, 50.0, "liver, vessel", thickness, angle)
    assert one.reason == reason

"""The path report against the built-in patient's recipe: 1000 random paths."""

from functools import lru_cache

import numpy as np
import pytest

from app.core.progress import Progress
from app.imaging.field.from_recipe import field_of_recipe
from app.imaging.field.grid import FieldGrid
from app.planning.lung_path.reporting import LungPaths
from tests.planning.lung_path_recipe import Recipe

NEAR_MM, NEAR_DEG = 0.5, 2.0
TOP_MM, FIELD_TOP_MM = 288.0, 304.0


@lru_cache(maxsize=1)
def patient(seed):
    """Return recipe, field of all of the chest, and its reports."""
    recipe = Recipe(seed)
    affine = np.eye(4)
    affine[:3, 3] = (-172.0, -120.0, 150.0)
    field = field_of_recipe(seed, FieldGrid((155, 232, 345), affine, 1.0, None, 0.0), Progress())
    return recipe, field, LungPaths(field)


def random_path(recipe, rng):
    """Return a path from the skin, clear of spine and sternum, to a place in the lung."""
    while True:
        target = rng.uniform((-140.0, -90.0, 215.0), (140.0, 85.0, TOP_MM - 6.0))
        if recipe.lung(target[None])[0] > -4.0:
            continue
        way = rng.normal(size=3) * (1.0, 1.0, 0.35)
        way /= np.linalg.norm(way)
        along = np.arange(0.0, 130.0, 0.25)
        line = target + along[:, None] * way
        outside = np.flatnonzero(recipe.place(line).skin > 0.0)
        if not len(outside):
            continue
        entry = line[outside[0]]
        x, y, z = entry / recipe.scale
        p = abs(np.arctan2(x, y)) / np.pi
        if 0.13 < p < 0.6 and 190.0 < z < TOP_MM:
            return entry, target


def differences(recipe, report, wanted):
    """Return what differs by more than is allowed, each in words."""
    found = []
    for name in ("pleura", "fissures"):
        mine, theirs = getattr(report, name), getattr(wanted, name)
        if len(mine) != len(theirs):
            found.append(f"{name}: {len(mine)} for {len(theirs)}, angles {theirs}")
            continue
        for one, (depth, angle) in zip(mine, theirs, strict=True):
            if abs(one.depth_mm - depth) > NEAR_MM or abs(one.angle_deg - angle) > NEAR_DEG:
                found.append(
                    f"{name}: {one.depth_mm:.2f} mm, {one.angle_deg:.1f}° for {depth:.2f} mm, "
                    f"{angle:.1f}°"
                )
    for name in ("lung_mm", "emphysema_mm", "rib_below_mm", "rib_above_mm", "intercostal_mm"):
        mine, theirs = getattr(report, name), getattr(wanted, name)
        if mine is None and report.pleura[0].place_mm[2] + theirs > FIELD_TOP_MM - 12.0:
            continue  # the rib lies beyond what is labelled
        if mine is None or abs(mine - theirs) > NEAR_MM:
            grazing = max((angle for _, angle in (*wanted.pleura, *wanted.fissures)), default=0.0)
            found.append(f"{name}: {mine} for {theirs:.2f} mm (flattest at {grazing:.0f}°)")
    return found


def check(seed, count):
    recipe, _, paths = patient(seed)
    rng = np.random.default_rng(seed)
    right, listed, kinds = 0, [], {}
    for number in range(count):
        entry, target = random_path(recipe, rng)
        off = differences(recipe, paths.report(entry, target), recipe.report(entry, target))
        right += not off
        listed += [f"patient {seed}, path {number}: {words}" for words in off]
        for words in off:
            kinds[words.split(":")[0]] = kinds.get(words.split(":")[0], 0) + 1
    print("\n".join(listed))
    print(f"{right / count:.1%} of {count} paths; off {kinds}")
    return right / count


@pytest.mark.long("statistics")
def test_random_paths_are_reported_as_the_recipe_has_them():
    assert check(2000, 25) >= 0.9


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seed", [2000, 2001, 2002, 2003])
def test_a_thousand_random_paths_are_reported_as_the_recipe_has_them(seed):
    assert check(seed, 250) >= 0.95

"""Zones of a generator, what they cover, and the margin, against integrals of another kind."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.spatial import cKDTree

from app.core.errors import ConfigurationError
from app.planning.ablation.covering import MOST_MM, margins_mm, volumes
from app.planning.ablation.generators import load_table, shipped_tables
from app.planning.ablation.zone import Zone
from app.planning.errors import PlanError

UP = np.array([0.0, 0.0, 1.0])


def ball(centre, radius):
    return Zone(np.asarray(centre, float), UP, radius, radius)


def lens(first, second):
    """Volume that two balls share, in closed form."""
    a, b = first.half_long_mm, second.half_long_mm
    d = float(np.linalg.norm(first.centre_mm - second.centre_mm))
    if d >= a + b:
        return 0.0
    if d <= abs(a - b):
        return 4.0 / 3.0 * np.pi * min(a, b) ** 3
    poly = d * d + 2.0 * d * (a + b) - 3.0 * (a - b) ** 2
    return float(np.pi * (a + b - d) ** 2 * poly / (12.0 * d))


def area_of_union_in(lesion, discs):
    """Area of a disc that a union of discs covers: by angles on the arcs that bound it (Green).

    The boundary of the union within the lesion is traced, arc by arc; each arc from angle p to q of
    a circle with centre c and radius r gives half the integral of x dy - y dx.
    """
    circles = [lesion, *discs]
    total = 0.0
    for number, (cx, cy, r) in enumerate(circles):
        if r <= 0.0:
            continue
        turns = [0.0, 2.0 * np.pi]
        for k, (ox, oy, s) in enumerate(circles):
            d = np.hypot(ox - cx, oy - cy)
            if k == number or s <= 0.0 or d >= r + s or d <= abs(r - s):
                continue
            towards = np.arctan2(oy - cy, ox - cx)
            half = np.arccos((d * d + r * r - s * s) / (2.0 * d * r))
            turns += [(towards - half) % (2.0 * np.pi), (towards + half) % (2.0 * np.pi)]
        turns = sorted(turns)
        for p, q in pairwise(turns):
            if q - p < 1e-12:
                continue
            x, y = cx + r * np.cos(0.5 * (p + q)), cy + r * np.sin(0.5 * (p + q))

            def inside(k, x=x, y=y):
                ox, oy, s = circles[k]
                return s > 0.0 and np.hypot(x - ox, y - oy) < s

            others = [inside(k) for k in range(1, len(circles)) if k != number]
            bounds = any(others) if number == 0 else inside(0) and not any(others)
            if bounds:
                turned = cx * (np.sin(q) - np.sin(p)) - cy * (np.cos(q) - np.cos(p))
                total += 0.5 * r * (r * (q - p) + turned)
    return total


def covered_by_slices(lesion, balls):
    """Volume of a lesion that balls cover: the areas above, integrated by Gauss and Kronrod."""
    every = [lesion, *balls]

    def area(z):
        discs = []
        for one in every:
            square = one.half_long_mm**2 - (z - one.centre_mm[2]) ** 2
            discs.append((*one.centre_mm[:2], np.sqrt(square) if square > 0.0 else 0.0))
        return area_of_union_in(discs[0], discs[1:])

    low, high = (lesion.centre_mm[2] + way * lesion.half_long_mm for way in (-1.0, 1.0))
    ends = [one.centre_mm[2] + way * one.half_long_mm for one in balls for way in (-1.0, 1.0)]
    breaks = sorted(end for end in ends if low < end < high)
    return quad(area, low, high, points=breaks or None, limit=400, epsabs=1e-4)[0]


@pytest.mark.long("statistics")
def test_a_balls_share_of_a_lesion_is_that_of_the_lens_formula():
    random = np.random.default_rng(1)
    for _ in range(12):
        lesion = ball(random.normal(size=3) * 40.0, random.uniform(8.0, 15.0))
        way = random.normal(size=3)
        apart = random.uniform(1.0, 26.0)
        zone = ball(lesion.centre_mm + apart * way / np.linalg.norm(way), random.uniform(7.0, 18.0))
        whole, covered = volumes(lesion.about_mm, [zone], lesion.box_mm)
        assert abs(whole - lesion.volume_mm3) < 1e-4 * lesion.volume_mm3
        assert abs(covered - lens(lesion, zone)) < 1e-4 * lesion.volume_mm3


@pytest.mark.long("statistics")
def test_unions_of_two_and_three_balls_cover_what_an_integral_over_slices_says():
    random = np.random.default_rng(2)
    worst = 0.0
    for case in range(10):
        lesion = ball(random.normal(size=3) * 40.0, random.uniform(9.0, 15.0))
        zones = []
        for _ in range(2 + case % 2):
            way = random.normal(size=3)
            at = lesion.centre_mm + random.uniform(4.0, 13.0) * way / np.linalg.norm(way)
            zones.append(ball(at, random.uniform(7.0, 13.0)))
        _, covered = volumes(lesion.about_mm, zones, lesion.box_mm)
        apart = abs(covered - covered_by_slices(lesion, zones)) / lesion.volume_mm3
        worst = max(worst, apart)
    assert worst < 1e-4


def test_the_integral_over_slices_is_itself_that_of_the_lens_formula():
    lesion, zone = ball([1.0, 2.0, 3.0], 11.0), ball([8.0, -2.0, 6.0], 9.0)
    assert covered_by_slices(lesion, [zone]) == pytest.approx(lens(lesion, zone), rel=1e-6)
    two = [ball([20.0, 2.0, 3.0], 12.0), ball([-18.0, 2.0, 3.0], 12.0)]
    both = sum(lens(lesion, one) for one in two)  # the two do not meet
    assert covered_by_slices(lesion, two) == pytest.approx(both, rel=1e-6)


@pytest.mark.long("statistics")
def test_what_spheroids_cover_is_what_random_places_say():
    random = np.random.default_rng(3)
    lesion = Zone(np.array([3.0, -4.0, 5.0]), np.array([1.0, 2.0, 0.5]), 15.0, 10.0)
    zones = [
        Zone(lesion.centre_mm + np.array(off), np.array(axis), 20.0, 9.0)
        for off, axis in (
            ((5.0, 0.0, 1.0), (0.2, 1.0, 0.1)),
            ((-6.0, 2.0, 0.0), (0.0, 1.0, 0.3)),
            ((0.0, 1.0, 7.0), (0.1, 1.0, -0.2)),
        )
    ]
    whole, covered = volumes(lesion.about_mm, zones, lesion.box_mm)
    assert abs(whole - lesion.volume_mm3) < 1e-4 * lesion.volume_mm3
    low, high = lesion.box_mm
    places = random.uniform(low, high, (2_000_000, 3))
    inside = lesion.about_mm(places) > 0.0
    hit = inside & (np.max([zone.about_mm(places) for zone in zones], axis=0) > 0.0)
    share = hit.sum() / inside.sum()
    sd = np.sqrt(share * (1.0 - share) / inside.sum())
    assert abs(covered / whole - share) < 4.0 * sd


@pytest.mark.long("statistics")
def test_the_depth_in_a_spheroid_is_the_distance_from_its_surface():
    random = np.random.default_rng(4)
    for halves in ((22.0, 15.0), (9.0, 14.0), (12.0, 12.0)):
        zone = Zone(np.array([1.0, 2.0, 3.0]), random.normal(size=3), *halves)
        points = zone.centre_mm + random.normal(size=(300, 3)) * 14.0
        away, _ = cKDTree(zone.surface_mm(0.12)).query(points)
        depth = zone.depths_mm(points)
        over = away - np.abs(depth)  # the nearest of places 0.12 mm apart is a little too far
        assert over.min() > -1e-9
        assert over.max() < 0.07
        assert np.median(over) < 0.001
        nearest = zone.nearest_mm(points)
        assert np.abs(zone.depths_mm(nearest)).max() < 1e-9
        assert np.abs(np.linalg.norm(nearest - points, axis=1) - np.abs(depth)).max() < 1e-9


def test_the_margin_of_a_ball_in_a_ball_is_the_difference_less_their_distance():
    lesion = ball([0.0, 0.0, 0.0], 10.0)
    zone = ball([0.0, 2.0, 0.0], 17.0)
    margins = margins_mm(lesion.surface_mm(0.8), [zone])
    assert float(margins.min()) == pytest.approx(17.0 - 10.0 - 2.0, abs=0.01)
    assert float(margins.max()) == pytest.approx(17.0 - 10.0 + 2.0, abs=0.05)
    short = margins_mm(lesion.surface_mm(0.8), [ball([0.0, 8.0, 0.0], 14.0)])
    assert float(short.min()) == pytest.approx(14.0 - 10.0 - 8.0, abs=0.01)


@pytest.mark.long("statistics")
def test_the_margin_in_a_union_is_what_brute_force_on_its_surface_says():
    random = np.random.default_rng(5)
    zones = [
        Zone(np.array(at), np.array(axis), 22.0, 15.0)
        for at, axis in (
            ((7.0, 0.0, 0.0), (0.05, 1.0, 0.0)),
            ((-4.0, 1.0, 6.0), (-0.05, 1.0, 0.05)),
            ((-4.0, 0.0, -6.0), (0.0, 1.0, -0.05)),
        )
    ]
    lesion = ball([0.0, 0.0, 0.0], 11.0)
    points = lesion.surface_mm(2.0) + random.normal(size=(1, 3)) * 0.1
    # All three surfaces in places 0.12 mm apart, less those that lie within another zone.
    fine = []
    for zone in zones:
        own = zone.surface_mm(0.12)
        for other in (one for one in zones if one is not zone):
            away = own - other.centre_mm
            along = away @ other.axis
            across = np.linalg.norm(np.cross(away, other.axis), axis=1)
            own = own[(along / 22.0) ** 2 + (across / 15.0) ** 2 >= 1.0]
        fine.append(own)
    brute = cKDTree(np.concatenate(fine)).query(points)[0]
    margins = margins_mm(points, zones)
    assert (margins > 0.0).all()
    # Creases: what lies between two places of the fine surface is what the brute force lacks.
    assert np.abs(margins - brute).max() < 0.1
    # A crease is no nearer than either surface without the other.
    alone = np.max([zone.depths_mm(points) for zone in zones], axis=0)
    assert (margins > alone - 0.02).all()


def test_no_margin_is_asked_for_beyond_the_capsule():
    lesion, zone = ball([0.0, 0.0, 0.0], 10.0), ball([0.0, 0.0, 4.0], 16.0)

    def in_organ(points):
        return points[:, 2] > -9.0  # the capsule cuts the lesion's lower pole

    surface = lesion.surface_mm(0.8)
    free = margins_mm(surface, [zone])
    within = margins_mm(surface, [zone], in_organ)
    assert float(free.min()) == pytest.approx(2.0, abs=0.02)
    # Nearest in the organ is where the zone's surface meets the capsule: found by a fine search.
    ring = np.sqrt(16.0**2 - 13.0**2)
    lesions_ring = np.hypot(ring - np.sqrt(max(0.0, 100.0 - 81.0)), 0.0)
    assert 2.1 < float(within.min()) <= lesions_ring + 0.05
    assert (within >= free - 1e-9).all()
    everything = margins_mm(surface, [ball([0.0, 0.0, 0.0], 60.0)], lambda p: p[:, 2] > 1e9)
    assert (everything == MOST_MM).all()


def test_a_table_without_the_generators_power_is_refused_in_one_line(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(
        "title: Mine\nenergy: microwave\nex_vivo: true\ntissue: liver\nsource: me\nahead_mm: 5\n"
        "ahead_source: me\nrows:\n  - {minutes: 5, long_mm: 30, short_mm: 20}\n",
        encoding="utf-8",
    )
    with pytest.raises(ConfigurationError, match=r"rows\[0\]\.power_w|rows.*power_w") as error:
        load_table(path)
    assert "\n" not in str(error.value)


def test_tables_say_in_what_they_were_measured_and_by_whom():
    names = shipped_tables()
    assert {load_table(name).energy.value for name in names} == {"microwave", "radio_frequency"}
    for name in names:
        table = load_table(name)
        assert ("ex vivo" in table.words) is table.ex_vivo
        assert "Acad Radiol" in table.source
        assert table.ahead_source


def test_a_power_that_the_table_does_not_have_is_refused_with_those_that_it_has():
    table = load_table("microwave-cooled-in-vivo")
    with pytest.raises(PlanError, match=r"45 W for 10 min .* 30 W 5 min, .* 60 W 20 min"):
        table.number_of(45.0, 10.0)
    with pytest.raises(PlanError, match="microwave-cooled-ex-vivo"):
        load_table("nobodys")


def test_a_zone_lies_about_the_needle_and_reaches_ahead_of_its_tip_as_the_table_says():
    table = load_table("radio-frequency-perfused-ex-vivo")
    number = table.number_of(30.0, 15.0)
    zone = table.zone(number, [10.0, 20.0, 30.0], [0.0, 2.0, 0.0])
    assert zone.depths_mm([[10.0, 27.5, 30.0]])[0] == pytest.approx(0.0, abs=1e-9)
    assert zone.depths_mm([[10.0, 27.5 - 35.0, 30.0]])[0] == pytest.approx(0.0, abs=1e-9)
    assert zone.volume_mm3 == pytest.approx(np.pi / 6.0 * 35.0 * 24.6**2)

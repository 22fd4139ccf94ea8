"""The dark band beyond a needle's ends against a small scanner that shares no code with it."""

from dataclasses import dataclass

import numpy as np
import pytest
from metal_projector import HALF, STEP_MM, Floats, Rod, scanned

from app.imaging.dark_band import add_bands
from app.imaging.scan_order import ScanNeedle

RADIUS, BORE = 0.635, 0.455
SLICE_MM, ROWS = 5.0, 4
END = 20.0
AT = STEP_MM * np.arange(-HALF, HALF + 1)
AWAY = (4, 10, 20, 40)


@dataclass(frozen=True)
class Case:
    """A needle along y: what the small scanner shows beyond its end at y = 20 mm.

    Attributes:
        start, end: of the needle [mm].
        shown: HU within 1.2 mm of its line, at `AWAY` beyond the end.
        bore: radius of the empty bore.
    """

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    shown: tuple[float, float, float, float]
    bore: float = 0.0


def leaning(first: float, last: float, angle_deg: float, z_at_last: float) -> tuple[Floats, Floats]:
    rise = (last - first) * np.tan(np.radians(angle_deg))
    return np.array([0.0, first, z_at_last - rise]), np.array([0.0, last, z_at_last])


def leaving(angle_deg: float, *shown: float) -> Case:
    """A shaft whose middle line leaves the slice at y = 20 mm."""
    beyond = SLICE_MM / 2 + 80.0 * np.tan(np.radians(angle_deg))
    start, end = leaning(-140.0, 100.0, angle_deg, float(beyond))
    return Case(tuple(start), tuple(end), shown)  # type: ignore[arg-type]


def ending(angle_deg: float, *shown: float) -> Case:
    """The same lean, the tip in the middle of the slice at y = 20 mm."""
    start, end = leaning(-140.0, END, angle_deg, 0.0)
    return Case(tuple(start), tuple(end), shown)  # type: ignore[arg-type]


CASES = {
    "tip, 100 mm in the slice": Case((0, -80, 0), (0, 20, 0), (-594, -384, -244, -136)),
    "tip, 40 mm in the slice": Case((0, -20, 0), (0, 20, 0), (-485, -292, -171, -83)),
    "tip, stylet out": Case((0, -20, 0), (0, 20, 0), (-278, -197, -135, -76), BORE),
    "tip, 5° out of the slice": ending(5.0, -377, -174, -82, -31),
    "shaft leaving at 5°": leaving(5.0, -55, -261, -123, -49),
    "tip, 10° out of the slice": ending(10.0, -204, -78, -27, -10),
    "shaft leaving at 10°": leaving(10.0, -322, -122, -44, -17),
}


def ours(case: Case) -> Floats:
    """Our band of a case in the small scanner's grid [HU]."""
    grid = np.diag([STEP_MM, STEP_MM, SLICE_MM, 1.0])
    grid[:2, 3] = AT[0]
    hu = np.zeros((len(AT), len(AT)), np.float32)
    needle = ScanNeedle(
        np.array(case.start, float), np.array(case.end, float), RADIUS,
        hollow=case.bore > 0.0, inner_radius_mm=case.bore,
    )  # fmt: skip
    add_bands(hu, needle, 0.0, SLICE_MM, grid)
    return hu


def along(picture: Floats) -> Floats:
    """Mean within 1.2 mm of the needle's line at `AWAY` beyond its end [HU]."""
    near = np.abs(AT) <= 1.2
    return np.array([picture[np.ix_(np.abs(AT - END - r) <= 1.0, near)].mean() for r in AWAY])


def at_ten(name: str) -> float:
    return float(along(ours(CASES[name]))[1])


@pytest.mark.parametrize("name", CASES)
def test_the_band_is_dark_and_as_deep_as_a_scanner_shows_it(name: str) -> None:
    case = CASES[name]
    shown, band = np.array(case.shown, float), along(ours(case))
    assert (band < 0.0).all()
    first = 1 if name.startswith("shaft") else 0  # nearer than that lies the tapering shaft itself
    np.testing.assert_allclose(band[first:], shown[first:], rtol=0.3, atol=15.0)


def test_the_order_of_the_bands_is_the_scanners() -> None:
    names = sorted(CASES, key=at_ten)
    assert names == sorted(CASES, key=lambda name: CASES[name].shown[1])


def test_a_tip_in_the_slice_has_a_longer_band_than_a_shaft_that_leaves_it() -> None:
    def length(values: Floats) -> float:
        """How far beyond the end the band is 100 HU deep [mm]."""
        return float(np.interp(100.0, -values[:0:-1], np.array(AWAY, float)[:0:-1]))

    for figures in (lambda case: np.array(case.shown, float), lambda case: along(ours(case))):
        tip, five, ten = (
            length(figures(CASES[name]))
            for name in ("tip, 100 mm in the slice", "shaft leaving at 5°", "shaft leaving at 10°")
        )
        assert tip > 1.3 * five > 2.0 * ten


def test_the_band_is_weaker_with_the_stylet_out_and_most_of_all_at_the_tip() -> None:
    solid, hollow = (along(ours(CASES[n])) for n in ("tip, 40 mm in the slice", "tip, stylet out"))
    share = hollow / solid
    assert (share < 1.0).all()
    assert (np.diff(share) > 0.0).all()


def test_a_needle_across_the_slice_or_beside_it_leaves_no_band() -> None:
    grid = np.diag([STEP_MM, STEP_MM, SLICE_MM, 1.0])
    for start, end in (((3, 3, -50), (3, 3, 50)), ((0, -20, 40), (0, 20, 42))):
        hu = np.zeros((50, 50), np.float32)
        needle = ScanNeedle(np.array(start, float), np.array(end, float), RADIUS)
        add_bands(hu, needle, 0.0, SLICE_MM, grid)
        assert not hu.any()


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", ["tip, 40 mm in the slice", "tip, stylet out",
                                  "shaft leaving at 5°", "shaft leaving at 10°"])  # fmt: skip
def test_the_figures_of_the_small_scanner_are_what_it_shows(name: str) -> None:
    case = CASES[name]
    rod = Rod(case.start, case.end, RADIUS, case.bore)
    with_needle = scanned((rod,), SLICE_MM / ROWS, ROWS)
    without = scanned((), SLICE_MM / ROWS, 1, fine=1)
    assert abs(without[HALF, HALF]) < 1.0  # water
    np.testing.assert_allclose(along(with_needle - without), case.shown, atol=8.0)

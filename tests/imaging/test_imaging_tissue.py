"""Tissues along a line: known slabs at any angle, noise, structures, phantoms, a real chest."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.imaging.body import find_body
from app.imaging.errors import ImagingError
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.series import Series
from app.imaging.structures.structure import Structure, StructureKind
from app.imaging.tissue import SHORTEST_MM, SKIN_MM, Tissue, TissueRun, tissue_along
from app.imaging.volume import Volume

SERIES = Series("2.25.1", "CT", "", (1, 1, 1), None, None, None, True, "", (), "p", "2.25.7", ())
SIZE, SPACING = (60, 160, 60), 0.9
SLABS = {0.0: -100.0, 16.0: 55.0, 30.0: -100.0, 36.0: 110.0, 76.0: -850.0, 90.0: 600.0}
"""Depth from which a value holds [mm], below a skin at y = 0."""


def slabs(values: dict[float, float], noise: float = 0.0, unit: str = "HU") -> Volume:
    """A CT of slabs across y, air before them; voxel (0, 0, 0) at (-27, -10, -27) mm."""
    y = -10.0 + SPACING * np.arange(SIZE[1])
    hu = np.full(SIZE[1], -1000.0)
    for begin, value in values.items():
        hu[y >= begin] = value
    field = np.broadcast_to(hu[None, :, None], SIZE[::-1][:1] + SIZE[1:2] + SIZE[:1]).copy()
    field += np.random.default_rng(5).normal(0.0, noise, field.shape) if noise else 0.0
    affine = np.diag([SPACING, SPACING, SPACING, 1.0])
    affine[:3, 3] = (-27.0, -10.0, -27.0)
    return Volume(field.astype(np.float32), affine, SERIES, unit=unit)


def kinds(runs: tuple[TissueRun, ...]) -> list[str]:
    return [run.tissue.value for run in runs]


WANTED = ["skin", "fat", "muscle", "fat", "organ", "lung", "bone"]


@pytest.mark.parametrize("tilt", [0.0, 0.2, -0.25])
@pytest.mark.parametrize("noise", [0.0, 30.0])
def test_known_slabs_are_found_at_any_angle_and_in_noise(tilt: float, noise: float) -> None:
    runs = tissue_along(slabs(SLABS, noise), (0.0, 0.0, 0.0), (tilt * 60.0, 60.0, 0.0))
    assert kinds(runs) == WANTED
    way = np.hypot(1.0, tilt)
    edges = way * np.array([0.0, 16.0, 30.0, 36.0, 76.0, 90.0])
    found = np.array([run.begin_mm for run in runs])
    np.testing.assert_allclose(found[2:], edges[1:], atol=1.3)  # a voxel and a half
    assert found[1] == SKIN_MM


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=40)
@given(
    st.lists(
        st.tuples(st.floats(0.2, 30.0), st.sampled_from([-900.0, -100.0, 40.0, 120.0, 700.0])),
        min_size=1,
        max_size=8,
    ),
    st.floats(0.0, 80.0),
)
def test_runs_are_joined_without_gaps_and_none_is_too_short(
    parts: list[tuple[float, float]], noise: float
) -> None:
    depths = np.cumsum([0.0, *(thickness for thickness, _ in parts)])
    values = {float(depth): hu for depth, (_, hu) in zip(depths, parts, strict=False)}
    runs = tissue_along(slabs(values, noise), (0.0, 0.0, 0.0), (0.0, 50.0, 0.0))
    assert runs[0].tissue is Tissue.SKIN
    assert runs[0].begin_mm == 0.0
    for above, below in pairwise(runs):
        assert above.end_mm == below.begin_mm
        assert (above.tissue, above.name) != (below.tissue, below.name)
    for run in runs[2:]:
        assert run.thickness_mm >= (1.0 if run.tissue is Tissue.BONE else SHORTEST_MM)


def test_wall_and_organ_without_fat_between_are_parted_where_the_values_change() -> None:
    touching = {0.0: -100.0, 12.0: 55.0, 30.0: 110.0}
    runs = tissue_along(slabs(touching, 10.0), (0.0, 0.0, 0.0), (0.0, 70.0, 0.0))
    assert kinds(runs) == ["skin", "fat", "muscle", "organ"]
    assert runs[3].begin_mm == pytest.approx(30.0, abs=1.5)
    same = {0.0: -100.0, 12.0: 55.0}
    runs = tissue_along(slabs(same, 10.0), (0.0, 0.0, 0.0), (0.0, 70.0, 0.0))
    assert runs[3].begin_mm - runs[2].begin_mm == pytest.approx(12.0)


def test_a_structure_knows_better_than_the_values() -> None:
    volume = slabs(SLABS)
    mask = np.ones((60, 20, 60), bool)
    vessel = Structure(
        "aorta",
        StructureKind.VESSEL,
        (255, 0, 0),
        mask,
        (0, 70, 0),
        volume.affine_mm,
    )
    runs = tissue_along(volume, (0.0, 0.0, 0.0), (0.0, 60.0, 0.0), structures=[vessel])
    named = [run for run in runs if run.name]
    assert [(run.tissue, run.name) for run in named] == [(Tissue.ORGAN, "aorta")]
    assert named[0].begin_mm == pytest.approx(-10.0 + 70 * SPACING, abs=1.0)
    assert named[0].thickness_mm == pytest.approx(18.0, abs=1.0)
    bone = replace(vessel, name="Rib 7")
    runs = tissue_along(volume, (0.0, 0.0, 0.0), (0.0, 60.0, 0.0), structures=[bone])
    assert [run.tissue for run in runs if run.name] == [Tissue.BONE]


def test_what_is_no_ct_or_begins_outside_is_refused() -> None:
    with pytest.raises(ImagingError, match="not in HU"):
        tissue_along(slabs(SLABS, unit=""), (0.0, 0.0, 0.0), (0.0, 60.0, 0.0))
    with pytest.raises(ImagingError, match="lies outside the CT"):
        tissue_along(slabs(SLABS), (0.0, -90.0, 0.0), (0.0, 60.0, 0.0))


@pytest.mark.long("statistics")
@pytest.mark.parametrize("noise", [0.0, 40.0])
@pytest.mark.parametrize("seed", [1, 3])
def test_a_phantoms_own_path_leads_through_its_wall_into_the_liver(seed: int, noise: float) -> None:
    volume, patient = load_ct(phantom_series(seed)), anatomy(seed)
    if noise:
        rough = volume.hu + np.random.default_rng(1).normal(0.0, noise, volume.hu.shape)
        volume = replace(volume, hu=rough.astype(np.float32))
    runs = tissue_along(volume, patient.entry_mm, patient.lesion_mm)
    assert kinds(runs) == ["skin", "fat", "muscle", "fat", "organ"]
    length = float(np.linalg.norm(np.subtract(patient.lesion_mm, patient.entry_mm)))
    assert runs[-1].begin_mm < length < runs[-1].end_mm
    assert 8.0 < runs[2].thickness_mm < 20.0


@pytest.mark.long("statistics")
def test_a_real_chest_has_its_ribs_and_lungs(shared_data: Path) -> None:
    volume = load_ct(shared_data / "ct_chest_lidc0314")
    body = find_body(volume)
    middle = volume.lps_mm(np.array([255.0, 255.0, 137.0]))

    def through(direction: tuple[float, float, float]) -> list[str]:
        out = np.array(direction) / np.linalg.norm(direction)
        places = middle + np.arange(0.0, 220.0, 0.5)[:, None] * out
        entry = places[np.flatnonzero(body.share(places) > 0.5)[-1]]
        return kinds(tissue_along(volume, entry, middle))

    assert through((1.0, 0.0, 0.0))[:5] == ["skin", "fat", "muscle", "bone", "lung"]
    between = through((0.7, -0.7, 0.0))
    assert between[:3] == ["skin", "fat", "muscle"]
    assert "bone" not in between[: between.index("lung")]

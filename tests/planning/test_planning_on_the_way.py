"""What lies on a planned way, in fields whose tissues are laid by hand in slabs of whole mm."""

import numpy as np
import pytest

from app.imaging.field import TissueField
from app.imaging.field.tissue_field import NOBODYS, FieldTissue, TissueKind
from app.planning.on_the_way import hindrances

KINDS = {"rib": TissueKind.BONE, "liver": TissueKind.ORGAN, "aorta": TissueKind.VESSEL}


def slabs(*layers, sure=0.9):
    """A field of layers (name, thickness [mm]) along x, 1 mm voxels, from x = 0 on."""
    names = tuple(dict.fromkeys(name for name, _ in layers))
    row = np.concatenate([np.full(mm, names.index(name) + 1) for name, mm in layers])
    labels = np.broadcast_to(row.astype(np.uint8), (60, 60, len(row))).copy()
    affine = np.eye(4)
    affine[:3, 3] = 0.5, -29.5, -29.5
    tissues = tuple(
        FieldTissue(n, KINDS.get(name, TissueKind.FAT), name, sure, "")
        for n, name in enumerate(names, 1)
    )
    return TissueField(labels, np.full(labels.shape, 20, np.int8), affine, (NOBODYS, *tissues))


def met(field, entry_x=0.0, target_x=60.0):
    return hindrances(field, (entry_x, 0.0, 0.0), (target_x, 0.0, 0.0))


def test_a_rib_is_named_with_the_depth_at_which_the_needle_comes_to_it():
    field = slabs(("fat", 12), ("rib", 6), ("liver", 62))
    (rib,) = met(field)
    assert (rib.name, rib.kind, rib.is_sure) == ("rib", TissueKind.BONE, True)
    assert rib.depth_mm == pytest.approx(12.0, abs=0.6)
    assert rib.length_mm == pytest.approx(6.0, abs=0.6)


def test_what_is_met_first_is_named_first_and_what_is_unsure_is_said_to_be():
    field = slabs(("fat", 10), ("aorta", 5), ("fat", 10), ("rib", 5), ("liver", 50), sure=0.3)
    assert [(one.name, one.is_sure) for one in met(field)] == [("aorta", False), ("rib", False)]


def test_a_way_beside_the_rib_meets_nothing_and_what_holds_the_target_is_none():
    field = slabs(("fat", 12), ("rib", 6), ("liver", 62))
    assert met(field, entry_x=20.0) == ()
    in_bone = slabs(("fat", 20), ("rib", 60))
    assert met(in_bone) == (), "the target lies in the bone"


def test_less_of_a_bone_than_the_map_of_entries_lets_pass_is_not_named():
    assert met(slabs(("fat", 12), ("rib", 1), ("liver", 67))) == ()


@pytest.mark.parametrize("name", ["small vessel", "lung vessel"])
def test_a_vessel_that_is_too_small_for_the_map_of_entries_hinders_no_plan(name, monkeypatch):
    monkeypatch.setitem(KINDS, name, TissueKind.VESSEL)
    assert met(slabs(("fat", 12), (name, 6), ("liver", 62))) == ()

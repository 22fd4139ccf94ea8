"""Labels of marks: in the pane, off each other, off needle and path."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.views.slices.labels import Wanted, arrange

PANE = (400.0, 300.0)
pixels = st.floats(0.0, 400.0)


def label(x, y, width=70.0, optional=False, last=0):
    return Wanted(x, y, width, 14.0, 7.0, last, optional)


def overlap(one, other):
    x, y, w, h = one
    u, v, a, b = other
    return x < u + a and u < x + w and y < v + b and v < y + h


def test_three_marks_on_one_spot_get_three_labels_apart():
    placed = arrange([label(200, 150), label(201, 151), label(203, 148)], PANE)
    rects = [place.rect for place in placed]
    assert not any(overlap(rects[i], rects[j]) for i, j in ((0, 1), (0, 2), (1, 2)))


@settings(derandomize=True, deadline=None, max_examples=60)
@given(x=pixels, y=st.floats(0.0, 300.0), width=st.floats(1.0, 150.0))
def test_a_label_in_a_pane_is_never_cut(x, y, width):
    (placed,) = arrange([label(x, y, width)], PANE)
    left, top, w, h = placed.rect
    assert left >= 0
    assert top >= 0
    assert left + w <= PANE[0] + 1e-9
    assert top + h <= PANE[1] + 1e-9


@pytest.mark.long("journey")
def test_a_mark_outside_the_pane_has_no_label():
    assert arrange([label(-5.0, 10.0), label(100.0, 301.0)], PANE) == [None, None]


def test_a_label_stays_off_the_line():
    line = [(200 + step, 150.0 - 0.3 * step) for step in range(0, 120, 8)]
    (placed,) = arrange([label(200, 150)], PANE, line)
    x, y, w, h = placed.rect
    assert not any(x <= u <= x + w and y <= v <= y + h for u, v in line)


def test_only_an_optional_label_is_left_out_where_there_is_no_room():
    small = (80.0, 30.0)
    crowd = [label(40, 15), label(42, 16), label(41, 14, optional=True)]
    placed = arrange(crowd, small)
    assert placed[0] is not None
    assert placed[1] is not None
    assert placed[2] is None


def test_a_label_keeps_its_place_while_nothing_speaks_against_it():
    first = arrange([label(200, 150)], PANE)[0].place
    near = arrange([label(200, 150, last=first + 1)], PANE)[0].place
    assert near == first + 1


@pytest.mark.parametrize("bad", [math.nan, math.inf])
def test_a_mark_without_a_place_has_no_label(bad):
    assert arrange([label(bad, 10.0)], PANE) == [None]


def test_a_label_stays_off_other_words_even_far_from_its_mark():
    corner = (0.0, 0.0, 300.0, 200.0)
    (placed,) = arrange([label(100, 90)], PANE, taken=[corner])
    x, y, w, h = placed.rect
    assert not overlap(placed.rect, corner)
    assert 0 <= x <= PANE[0] - w
    assert 0 <= y <= PANE[1] - h


def test_a_label_is_left_out_where_other_words_leave_no_room():
    assert arrange([label(100, 90)], PANE, taken=[(0.0, 0.0, 390.0, 295.0)]) == [None]
    assert arrange([label(40, 40, width=120.0)], (72.0, 72.0)) == [None]


def test_a_label_stays_off_a_name_and_covers_it_only_where_there_is_no_other_place():
    (alone,) = arrange([label(200, 150)], PANE)
    (placed,) = arrange([label(200, 150)], PANE, names=[alone.rect])
    assert not overlap(placed.rect, alone.rect)
    (crowded,) = arrange([label(200, 150)], PANE, names=[(0.0, 0.0, *PANE)])
    assert crowded is not None

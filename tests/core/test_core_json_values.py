import json
from enum import IntEnum, StrEnum
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.core.arrays import cross, crosses
from app.core.json_values import compact, finite


class Word(StrEnum):
    ONE = "one"


class Number(IntEnum):
    TWO = 2


PLAIN = st.none() | st.booleans() | st.integers() | st.text(max_size=5) | st.floats()
NUMPY = st.floats(width=32).map(np.float32) | st.integers(-9, 9).map(np.int64)
LEAVES = PLAIN | NUMPY | st.sampled_from([Word.ONE, Number.TWO, Path("a"), np.bool_(True)])
LEAVES = LEAVES | st.lists(st.floats(), max_size=3).map(np.array)
DOCUMENTS = st.recursive(
    LEAVES,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.lists(inner, max_size=3).map(tuple)
        | st.dictionaries(st.text(max_size=3), inner, max_size=3)
        | st.dictionaries(st.text(max_size=3), inner, max_size=3).map(MappingProxyType)
    ),
)


@pytest.mark.long("journey")
@given(document=DOCUMENTS)
def test_a_document_written_as_it_is_reads_as_one_that_was_copied_first(document):
    copied = json.dumps(finite(document), separators=(",", ":"), allow_nan=False)
    assert compact(document) == copied


def test_what_is_not_finite_is_null():
    assert (
        compact({"a": [1.0, float("nan")], "b": np.array([np.inf])})
        == '{"a":[1.0,null],"b":[null]}'
    )


@given(numbers=st.lists(st.floats(-1e100, 1e100), min_size=6, max_size=6))
def test_the_cross_product_is_that_of_numpy_to_the_last_bit(numbers):
    a, b = np.array(numbers[:3]), np.array(numbers[3:])
    assert np.array_equal(cross(a, b), np.cross(a, b))


def test_the_cross_products_of_stacks_are_those_of_numpy_to_the_last_bit():
    rng = np.random.default_rng(1)
    for one, other in (((3,), (3,)), ((3,), (7, 3)), ((5, 1, 3), (5, 2, 3)), ((9, 3), (9, 3))):
        a, b = rng.normal(size=one), rng.normal(size=other)
        np.testing.assert_array_equal(crosses(a, b), np.cross(a, b), strict=True)

"""Transforms to and from 3D Slicer, with SimpleITK as the judge."""

import contextlib

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform
from app.exchange.errors import ExportError, TransformError
from app.exchange.transforms import parse_tfm, read_tfm, tfm_text, write_tfm

angles = st.floats(-3.1, 3.1)
lengths = st.floats(-500.0, 500.0)
triples = st.tuples(lengths, lengths, lengths)


def transform(seed=1):
    rng = np.random.default_rng(seed)
    return RigidTransform(rotation_exp(rng.normal(size=3)), rng.normal(size=3))


def itk():
    return pytest.importorskip("SimpleITK", reason="SimpleITK (extra bench) is not installed")


def test_a_transform_comes_back_to_the_last_digits(tmp_path):
    for seed in range(20):
        write_tfm(tmp_path / "a.tfm", transform(seed))
        back = read_tfm(tmp_path / "a.tfm")
        np.testing.assert_allclose(back.matrix(), transform(seed).matrix(), atol=1e-14)


def test_itk_reads_the_inverse_as_slicer_expects_it(tmp_path):
    sitk = itk()
    T_parent_local = transform()
    write_tfm(tmp_path / "a.tfm", T_parent_local)
    read = sitk.ReadTransform(str(tmp_path / "a.tfm"))
    p_local = np.array([0.01, -0.02, 0.03])
    p_parent = T_parent_local @ p_local
    np.testing.assert_allclose(read.TransformPoint((1e3 * p_parent).tolist()), 1e3 * p_local,
                               atol=1e-9)  # fmt: skip


def judged(made, tmp_path):
    """What Acus reads of a transform that ITK wrote must carry points as ITK does."""
    sitk = itk()
    sitk.WriteTransform(made, str(tmp_path / "itk.tfm"))
    T_to_from = read_tfm(tmp_path / "itk.tfm")
    for point in ((0.0, 0.0, 0.0), (10.0, -20.0, 30.0), (-300.0, 4.0, 77.0)):
        ours = 1e3 * (T_to_from.inverse() @ (np.array(point) / 1e3))
        np.testing.assert_allclose(ours, made.TransformPoint(point), atol=1e-7)


@settings(max_examples=40, deadline=None)
@given(turn=st.tuples(angles, angles, angles), shift=triples, centre=triples, zyx=st.booleans())
def test_euler_transforms_with_a_centre_are_read_as_itk_means_them(
    tmp_path_factory, turn, shift, centre, zyx
):
    made = itk().Euler3DTransform(centre, *turn, shift)
    made.SetComputeZYX(zyx)
    judged(made, tmp_path_factory.mktemp("tfm"))


@settings(max_examples=40, deadline=None)
@given(axis=triples, angle=angles, shift=triples, centre=triples)
def test_versors_and_affine_matrices_are_read_as_itk_means_them(
    tmp_path_factory, axis, angle, shift, centre
):
    axis = axis if np.linalg.norm(axis) > 1.0 else (0.0, 0.0, 1.0)
    versor = itk().VersorRigid3DTransform(axis, angle, shift, centre)
    folder = tmp_path_factory.mktemp("tfm")
    judged(versor, folder)
    judged(itk().AffineTransform(versor.GetMatrix(), shift, centre), folder)
    judged(itk().TranslationTransform(3, shift), folder)


AFFINE = "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "does not begin"),
        ("{}", "does not begin"),
        (AFFINE, "no line 'Parameters'"),
        (AFFINE + "Parameters: 1 0 0 0 1 0 0 0 1 0 0\n", "11 parameters; 12"),
        (AFFINE + "Parameters: 1 0 0 0 1 0 0 0 x 0 0 0\n", "not numbers"),
        (AFFINE + "Parameters: 1 0 0 0 1 0 0 0 nan 0 0 0\n", "not finite"),
        (AFFINE + "Parameters: 2 0 0 0 1 0 0 0 1 0 0 0\n", "stretches by 1 to 2"),
        (AFFINE + "Parameters: 1 0.1 0 0 1 0 0 0 1 0 0 0\n", "scale or shear"),
        (AFFINE + "Parameters: -1 0 0 0 1 0 0 0 1 0 0 0\n", "mirrors"),
        (AFFINE + "Parameters: 0 0 0 0 0 0 0 0 0 0 0 0\n", "stretches by 0"),
        (AFFINE.replace("_3_3", "_2_2") + "Parameters: 1 0 0 1 0 0\n", "in 3D"),
        (AFFINE.replace("Affine", "BSpline") + "Parameters: 1\n", "BSplineTransform_double_3_3"),
        (AFFINE.replace("Affine", "Similarity3D") + "Parameters: 1\n", "Similarity3D"),
        (AFFINE.replace("AffineTransform", "VersorRigid3DTransform")
         + "Parameters: 1 1 0 0 0 0\n", "versor"),
        (tfm_text(transform()) + "Transform: AffineTransform_double_3_3\n", "several transforms"),
    ],
)  # fmt: skip
def test_what_is_no_rigid_transform_is_refused_with_the_reason(text, words):
    with pytest.raises(TransformError, match=words):
        parse_tfm(text, "a.tfm")


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=200))
def test_any_text_is_a_transform_or_a_named_error(text):
    with contextlib.suppress(TransformError):
        parse_tfm("#Insight Transform File V1.0\n" + text, "a.tfm")


def test_a_file_that_cannot_be_read_or_written_is_named(tmp_path):
    with pytest.raises(TransformError, match="cannot read"):
        read_tfm(tmp_path / "missing.tfm")
    (tmp_path / "binary.tfm").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TransformError, match="not text"):
        read_tfm(tmp_path / "binary.tfm")
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_tfm(tmp_path / "file" / "a.tfm", transform())

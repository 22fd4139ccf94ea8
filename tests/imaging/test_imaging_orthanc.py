"""Against a real archive: Orthanc of Debian's packages."""

import numpy as np
import pydicom
import pytest
from dicom_factory import SERIES, Slices
from orthanc_rig import Orthanc

from app.core.progress import Progress
from app.imaging.library import CtLibrary
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.errors import (
    PacsDataError,
    PacsError,
    PacsRefusedError,
    PacsUnreachableError,
)
from app.imaging.pacs.incoming import Incoming
from app.imaging.pacs.query import Query
from app.imaging.pacs.taking import take
from app.imaging.reading import load_ct

STUDY = "2.25.1"


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stored")
    recipe = Slices(offsets=tuple(2.0 * k for k in range(40)), shape=(64, 64))
    recipe.tags["StudyDate"] = "20240229"
    recipe.write(folder)
    return folder


@pytest.fixture(scope="module")
def orthanc(tmp_path_factory, stored):
    with Orthanc(tmp_path_factory.mktemp("orthanc")) as archive:
        archive.store(stored)
        yield archive


@pytest.mark.long("journey")
def test_it_answers(orthanc):
    assert Pacs(orthanc.settings()).echo() < 5.0


@pytest.mark.long("journey")
def test_what_was_stored_is_found_by_patient_and_by_date(orthanc):
    client = Pacs(orthanc.settings())
    for query in (Query(patient_id="SECRET*"), Query(date="20240201-20240301")):
        (study,) = client.find_studies(query)
        assert (study.uid, study.instances) == (STUDY, 40)
        assert "CT" in study.modalities
        (series,) = client.find_series(study)
        assert (series.uid, series.instances) == (SERIES, 40)
    assert client.find_studies(Query(patient_id="NOBODY")) == []
    assert client.find_studies(Query(patient_id="SECRET*", modality="MR")) == []


@pytest.mark.long("journey")
@pytest.mark.parametrize("way", ["get", "move"])
def test_a_series_enters_the_library_with_the_same_voxels_and_no_names(orthanc, stored, way):
    settings = orthanc.settings(retrieve=way)
    imported = take(Pacs(settings), STUDY, SERIES, CtLibrary(), Progress())
    before, after = load_ct(stored), load_ct(imported.entry.folder)
    np.testing.assert_array_equal(before.hu, after.hu)
    np.testing.assert_allclose(before.affine_mm, after.affine_mm)
    one = pydicom.dcmread(min(imported.entry.folder.glob("*.dcm")))
    assert "Secret" not in str(one)
    assert not Incoming(settings, SERIES).folder.exists()


@pytest.mark.long("journey")
def test_only_what_is_missing_is_fetched_again(orthanc):
    settings = orthanc.settings()
    incoming = Incoming(settings, SERIES).open()
    client = Pacs(settings)
    client.retrieve(STUDY, SERIES, incoming, Progress())
    files = sorted(incoming.folder.glob("*.dcm"))
    for path in files[:7]:
        path.unlink()
    kept = {path: path.stat().st_mtime_ns for path in files[7:]}
    told = []
    client.retrieve(STUDY, SERIES, incoming, Progress(lambda _, text: told.append(text)))
    assert incoming.count() == 40
    assert {path: path.stat().st_mtime_ns for path in kept} == kept
    assert sum("received" in text for text in told) == 7
    incoming.forget()


@pytest.mark.long("journey")
def test_a_caller_it_does_not_know_is_refused_in_words(orthanc):
    stranger = orthanc.settings(own_title="STRANGER")
    with pytest.raises(PacsError):
        Pacs(stranger).find_studies(Query(patient_id="*"))
    with pytest.raises(PacsRefusedError, match="AE title"):
        Pacs(orthanc.settings(title="OTHER")).echo()


@pytest.mark.long("journey")
def test_a_destination_it_does_not_know_is_said(orthanc):
    elsewhere = orthanc.settings(retrieve="move", own_port=1 + orthanc.own_port)
    with pytest.raises(PacsError):
        take(Pacs(elsewhere), STUDY, SERIES, CtLibrary(), Progress())
    assert CtLibrary().entries() == ()


@pytest.mark.long("journey")
def test_a_series_it_has_not_got_is_said(orthanc):
    with pytest.raises(PacsDataError, match="no such study or series"):
        take(Pacs(orthanc.settings()), STUDY, "2.25.404", CtLibrary(), Progress())
    assert CtLibrary().entries() == ()


@pytest.mark.long("journey")
def test_killed_in_mid_retrieve_it_leaves_nothing_half_imported(tmp_path, stored):
    with Orthanc(tmp_path / "orthanc") as archive:
        archive.store(stored)
        settings = archive.settings(timeout_s=10.0)
        progress = Progress(lambda _, text: archive.kill() if text.startswith("9 of") else None)
        with pytest.raises((PacsUnreachableError, PacsDataError)):
            take(Pacs(settings), STUDY, SERIES, CtLibrary(), progress)
        assert CtLibrary().entries() == ()
        assert 9 <= Incoming(settings, SERIES).count() <= 40

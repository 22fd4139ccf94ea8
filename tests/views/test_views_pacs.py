"""The PACS in the window: search, retrieval into the library, failures."""

import sys
import time
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QDialogButtonBox, QToolButton, QWidget

sys.path.append(str(Path(__file__).parents[1] / "imaging"))

from dicom_factory import Slices
from pacs_rig import FakePacs
from test_views_library import NoIndicator, mask_dialog, until

from app.core import paths as core_paths
from app.imaging.library import CtLibrary
from app.imaging.pacs.client import Pacs
from app.imaging.pacs.query import Query
from app.imaging.pacs.settings import keep
from app.views.pacs.feature import PacsImport
from app.views.pacs.panel import PacsPanel
from app.views.series.feature import LibraryImport


class Desk:
    def __init__(self, window):
        self.library = LibraryImport(NoIndicator(), window)
        self.pacs = PacsImport(NoIndicator(), window)
        self.pacs.taking.connect(self.library.intake.begin)


@pytest.fixture(scope="module")
def own_application():
    return QApplication.instance() or QApplication([])


@pytest.fixture
def desk(own_application):
    window = QWidget()
    yield Desk(window)
    window.deleteLater()


@pytest.mark.long("journey")
def test_the_panel_searches_shows_and_hands_over(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        keep((pacs.settings(),))
        desk.pacs.ask()
        panel = desk.pacs.panel
        panel.query()
        assert "what to look for" in panel.note.text()
        assert not panel.take.isEnabled()
        panel.patient.setText("SECRET*")
        panel.query()
        until(lambda: panel.take.isEnabled())
        assert panel.tree.topLevelItem(0).text(6) == "5"
        panel.take.click()
        mask_dialog(desk.library).take.click()
        until(lambda: desk.library.intake.report is not None)
    assert len(CtLibrary().entries()) == 1
    assert aside() == 0


@pytest.mark.long("journey")
def test_a_retrieved_series_that_is_given_up_is_deleted(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored") as pacs:
        client = Pacs(pacs.settings())
        study = client.find_studies(Query(patient_id="SECRET*"))[0]
        desk.pacs.retrieve(pacs.settings(), client.find_series(study)[0])
        dialog = mask_dialog(desk.library)
        assert aside() == 5
        dialog.reject()
    assert aside() == 0
    assert desk.library.entries() == []


@pytest.mark.long("journey")
def test_an_interrupted_retrieval_is_shown_and_resumed(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    failed = []
    desk.pacs.failed.connect(failed.append)
    with FakePacs(tmp_path / "stored", "cut") as pacs:
        keep((pacs.settings(),))
        for ill in ("cut", ""):
            pacs.ill = ill
            desk.pacs.ask()
            panel = desk.pacs.panel
            panel.patient.setText("SECRET*")
            panel.query()
            until(lambda p=panel: p.take.isEnabled())
            shown = panel.tree.topLevelItem(0).text(6)
            assert shown == ("5" if ill else "2 of 5 here, to be resumed")
            panel.take.click()
            until(lambda: failed)
        mask_dialog(desk.library).take.click()
        until(lambda: desk.library.intake.report is not None)
    assert len(CtLibrary().entries()) == 1


def aside():
    """Pictures that are kept aside, not yet de-identified."""
    return len(list((core_paths.data() / "incoming").rglob("*.dcm")))


def test_a_search_that_fails_is_said_in_the_panel(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored", "find fails") as pacs:
        keep((pacs.settings(),))
        panel = PacsPanel()
        panel.name.setText("S*")
        panel.query()
        until(lambda: "out of resources" in panel.note.text())
        assert panel.search.isEnabled()
        panel.deleteLater()


def test_a_search_can_be_cancelled_in_the_panel(desk, tmp_path):
    Slices().write(tmp_path / "stored")
    with FakePacs(tmp_path / "stored", "slow find") as pacs:
        keep((pacs.settings(timeout_s=20.0),))
        panel = PacsPanel()
        panel.name.setText("S*")
        panel.query()
        until(lambda: pacs.asked)
        start = time.monotonic()
        panel.strip.findChild(QToolButton).click()
        until(lambda: panel.search.isEnabled())
        assert time.monotonic() - start < 15.0
        panel.deleteLater()


def test_without_a_configured_pacs_the_panel_leads_to_the_configuration(desk):
    desk.pacs.ask()
    panel = desk.pacs.panel
    assert "Configure" in panel.note.text()
    assert not panel.search.isEnabled()
    panel.configure.click()
    dialog = desk.pacs.configuration
    dialog.add_button.click()
    dialog.form.fields["host",].setText("127.0.0.1")
    dialog.form.fields["title",].setText("FAKE")
    dialog.buttons.button(QDialogButtonBox.StandardButton.Save).click()
    assert panel.search.isEnabled()
    assert "pacs  (FAKE, 127.0.0.1:104)" in panel.servers.currentText()
    panel.reject()

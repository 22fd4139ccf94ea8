"""Pictures of dialogs around the CT: series of a folder, report of an import, the PACS."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from app.imaging.library import CtLibrary
from app.imaging.pacs.query import FoundSeries, FoundStudy
from app.imaging.pacs.settings import PacsSettings, keep
from app.imaging.scanning import scan_folder
from app.views.pacs.panel import PacsPanel
from app.views.series.browser import SeriesBrowser
from app.views.series.intake import ImportReport
from tools.reading_studio import Studio
from tools.robot_pictures import pause, wait

MIXED = ("ct_must_not_guess", "ct_enhanced", "ct_phantom_study")
"""Folders of the test data that, together, hold what a hospital's folder may hold."""


def series(studio: Studio) -> None:
    """Show the browser on a folder with series of every kind; needs the test data."""
    if studio.chest is None:
        return
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "from-the-scanner"
        for name in MIXED:
            shutil.copytree(studio.chest.parent / name, folder / name)
        browser = SeriesBrowser(scan_folder(folder), studio.window)
        browser.resize(980, 900)
        browser.show()
        wait(lambda: not browser.thumbnails.is_busy)
        pause(0.5)
        studio.keep("reading-series", browser)
        browser.close()


def report(studio: Studio) -> None:
    """Show what an import of the chest has removed; needs the test data."""
    if studio.chest is None:
        return
    page = ImportReport(CtLibrary().import_series(scan_folder(studio.chest).series[0]))
    page.resize(860, 620)
    page.show()
    studio.keep("privacy-report", page)
    page.close()


def pacs(studio: Studio) -> None:
    """Show the browser of an archive with what a search might bring; nobody in it is real."""
    keep((PacsSettings(name="archive", host="pacs.hospital.example", port=104, title="ARCHIVE"),))
    panel = PacsPanel()
    panel.patient.setText("40071*")
    panel.show_found([(series, 0) for series in _found()])
    panel.show()
    studio.keep("pacs-panel", panel)
    panel.close()


def _found() -> tuple[FoundSeries, ...]:
    rows = (
        ("4007114", "20260914", "CT thorax", "2", "Thorax 1.0 B30f", "CHEST", 275),
        ("4007114", "20260914", "CT thorax", "3", "Thorax 1.0 B70f", "CHEST", 275),
        ("4007114", "20260914", "CT thorax", "1", "Topogram", "CHEST", 1),
        ("4007158", "20261002", "CT liver, biopsy", "4", "Liver 3.0 venous", "ABDOMEN", 96),
        ("4007158", "20261002", "CT liver, biopsy", "5", "Control", "ABDOMEN", 3),
    )
    return tuple(
        FoundSeries(
            f"1.2.{number}",
            FoundStudy(f"1.1.{number}", date, "EXAMPLE^NOBODY", patient, "", study, ("CT",), None),
            number,
            "CT",
            words,
            part,
            pictures,
        )
        for patient, date, study, number, words, part, pictures in rows
    )

"""What opening a CT offers where it cannot be read as it is."""

import numpy as np

from app.imaging import memory
from app.views.series.browser import SeriesBrowser
from tests.imaging.dicom_factory import Slices


def test_a_series_that_turns_out_too_large_is_offered_at_half_size(
    window, tmp_path, settle, monkeypatch
):
    """Its headers promise values of 16 bits; only reading shows that they need 32."""
    picture = np.zeros((12, 16), "<u2")
    picture[2:10, 2:14] = 60000
    Slices(tags={"PixelData": picture.tobytes()}).write(tmp_path)
    monkeypatch.setattr(memory, "available", lambda: 5000)
    monkeypatch.setattr(memory, "open_bytes", lambda: 0)
    opened, failed = [], []
    window.open_ct.opened.connect(opened.append)
    window.open_ct.failed.connect(failed.append)
    window.open_ct.open_folder(tmp_path)
    assert settle(lambda: bool(window.findChildren(SeriesBrowser)))
    (browser,) = window.findChildren(SeriesBrowser)
    (card,) = browser.cards
    assert "values beyond 16 bits" in card.verdict.text()
    assert [button.text() for button, _ in card.buttons] == ["Open at half size"]
    card.buttons[0][0].click()
    assert settle(lambda: bool(opened or failed))
    assert not failed
    assert "reduced: 2 × 2 × 1 voxels averaged to one" in opened[0].label


def test_a_folder_of_which_nothing_can_be_used_says_why_and_offers_what_helps(
    window, tmp_path, settle
):
    Slices(offsets=(0.0, 2.0, 4.0, 6.3, 8.0)).write(tmp_path)
    opened = []
    window.open_ct.opened.connect(opened.append)
    window.open_ct.open_folder(tmp_path)
    assert settle(lambda: bool(window.findChildren(SeriesBrowser)))
    (browser,) = window.findChildren(SeriesBrowser)
    (card,) = browser.cards
    assert "uneven spacing" in card.verdict.text()
    card.buttons[0][0].click()
    assert settle(lambda: bool(opened))
    assert "resampled from slices 1.7 to 2.3 mm apart" in opened[0].label

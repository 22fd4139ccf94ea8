"""Somebody else's marker extractor is tried before it is imported, with pictures of every kind."""

import pytest
from extending_page import example

from app.tracking.errors import TrackingError
from app.tracking.markers.choice import KIND, extractors
from app.tracking.optics.rig import load_rig

NAME, CODE = example("How to add a marker extractor")
SEARCH = "        strength = self._strength(image)\n        if strength.max()"
FIND = "        return self.search(image)[0]\n"


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_EXTRACTORS", str(tmp_path))
    return tmp_path


def save(folder, *replaced):
    code = CODE
    for old, new in replaced:
        assert old in code
        code = code.replace(old, new)
    (folder / NAME).write_text(code, encoding="utf-8")


@pytest.mark.long("statistics")
def test_the_extractor_of_the_page_passes_and_is_remembered(own):
    save(own)
    assert len(extractors(load_rig("wide"), "strongest_spot")) == 2
    verdict = KIND.trial.known(own / NAME)
    assert verdict["reason"] == ""
    assert verdict["states"] > 40
    assert verdict["seconds"] < 10.0


HARMFUL = {
    "raises": (
        (FIND, f"        if hint.uv[0] != hint.uv[0]:\n            raise ValueError('no')\n{FIND}"),
        r"find\(\) with a hint of the pixel nan on a black picture of \d+ x \d+ raises ValueError:"
        r" no; return a Miss instead",
    ),
    "writes": ((SEARCH, f"        image[0, 0] = 0\n{SEARCH}"), r"search\(\) .* read-only"),
    "nothing": ((FIND, "        return None\n"), r"find\(\) .* gives None; give a MarkerFix or a"),
    "endless": (
        (FIND, f"        while image.max() == 255:\n            pass\n{FIND}"),
        r"find\(\) .* white picture of \d+ x \d+ did not return within 5 s",
    ),
    "mask": ((".astype(np.uint8)", ".astype(bool)"), r"mask\(\) .* gives bool .*; give uint8"),
    "nan": (
        ("pixels.mean(axis=0), covariance", "pixels.mean(axis=0) / 0.0, covariance"),
        r"finite|not of that shape|RuntimeWarning|gives",
    ),
    "small": (
        (SEARCH, f"        if image.shape[0] < 3:\n            return image[5]\n{SEARCH}"),
        r"search\(\) on a black picture of 1 x 1 raises IndexError",
    ),
    "ends": (
        ("    return StrongestSpot(setup)", "    raise SystemExit"),
        r"extractor\(\) does not work",
    ),
}


LONG = pytest.mark.long("statistics")
SOON = ("raises", "endless")


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[LONG] * (name not in SOON)) for name in HARMFUL]
)
def test_an_extractor_that_could_stop_the_tracker_is_refused(own, name):
    change, reason = HARMFUL[name]
    save(own, change)
    with pytest.raises(TrackingError, match=reason) as caught:
        extractors(load_rig("wide"), "strongest_spot")
    assert str(own / NAME) in str(caught.value)
    assert "strongest_spot" in str(KIND.refused())


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", ["thesis", "outline_centroid", "ellipse", "model_fit"])
def test_every_extractor_of_the_program_passes_the_same_trial(name):
    assert KIND.trial.verdict(KIND.find(name).path)["reason"] == ""

"""Sounds of an attempt: heard, seen, muted, remembered."""

import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from window_rig import plan

from app.core.events import Event
from app.exercises.library import load_exercise
from app.session.machine import State
from app.views.kit.verdict import Verdict
from app.views.shell.window import MainWindow
from app.views.sounds.feature import RATE, Cue, CueKind, MixerSpeaker, SoundsFeature, samples, words


class FakeSpeaker:
    def __init__(self):
        self.played, self.is_closed = [], False

    def play(self, cue, volume):
        self.played.append((cue.kind.value, volume))

    def close(self):
        self.is_closed = True


@pytest.fixture
def speaker():
    return FakeSpeaker()


@pytest.fixture
def open_window(application, services, destroy, settle, monkeypatch):
    """Opens a window whose sounds go to a speaker of ours."""
    windows = []

    def open_(make):
        monkeypatch.setattr(SoundsFeature, "make_speaker", make)
        window = MainWindow(services)
        destroy(window)
        window.show()
        windows.append(window)
        return window, window.feature(SoundsFeature)

    yield open_
    for window in windows:
        window.editor.saved(Path("kept"))


@pytest.fixture
def running(open_window, patient, speaker, settle):
    """A window in the middle of an attempt."""
    window, sounds = open_window(lambda: speaker)
    window.conductor.set_exercise(load_exercise("first-insertion"))
    window.show_patient(patient)
    plan(window)
    settle(lambda: window.conductor.controller.run is not None)
    window.conductor.controller.begin("ada")
    settle(lambda: sounds._speaker is not None)
    window.conductor.controller._timer.stop()
    return window, sounds


def moment(window, **fields):
    controller = window.conductor.controller
    snapshot = controller.run.trainer.snapshot()
    pose = replace(snapshot.pose, depth=fields.pop("depth", 0.01))
    offset = replace(snapshot.offset, **fields)
    controller.snapshot_taken.emit(
        replace(snapshot, state=State.INSERTING, pose=pose, offset=offset)
    )


def seen(sounds):
    return [(item.verdict, item.text) for item in sounds.items(None)]


@pytest.mark.long("journey")
def test_a_cue_is_heard_and_written(running, speaker):
    window, sounds = running
    moment(window, depth=0.021, lateral=0.0, remaining=0.05)
    assert [kind for kind, _ in speaker.played][-1] == "deeper"
    assert seen(sounds) == [(Verdict.GOOD, "21 mm deep")]
    moment(window, depth=0.021, lateral=0.03, remaining=0.05)
    assert seen(sounds) == [(Verdict.WARNING, "off the path")]


@pytest.mark.long("journey")
def test_muted_it_is_seen_still_and_stays_muted(running, speaker, open_window):
    window, sounds = running
    sounds.menu.on.trigger()
    speaker.played.clear()
    moment(window, depth=0.031, lateral=0.0, remaining=0.04)
    assert speaker.played == []
    assert seen(sounds) == [(Verdict.GOOD, "31 mm deep")]
    _, again = open_window(FakeSpeaker)
    assert not again.is_on
    assert not again.menu.on.isChecked()
    again.menu.on.trigger()
    assert again.is_on


@pytest.mark.long("journey")
def test_scans_and_structures_come_from_their_events(running, speaker):
    window, _ = running
    speaker.played.clear()
    for kind in ("scan", "breach", "state"):
        window.conductor.controller.event_seen.emit(Event(1.0, kind, "words"))
    assert [kind for kind, _ in speaker.played] == ["scan", "breach"]


@pytest.mark.long("journey")
def test_another_volume_is_heard_at_once(running, speaker):
    _, sounds = running
    sounds.menu.volumes["loud"].trigger()
    assert speaker.played[-1] == ("on_path", 1.0)
    assert sounds.volume == "loud"


@pytest.mark.long("journey")
def test_without_a_sound_card_the_menu_says_so_and_all_is_seen(
    open_window, patient, settle, services
):
    def none():
        raise OSError("no sound: no card")

    window, sounds = open_window(none)
    window.conductor.set_exercise(load_exercise("first-insertion"))
    window.show_patient(patient)
    plan(window)
    settle(lambda: window.conductor.controller.run is not None)
    window.conductor.controller.begin("ada")
    settle(lambda: bool(sounds.silence))
    sounds.menu.refresh()
    assert sounds.menu.on.toolTip() == "no sound: no card"
    moment(window, depth=0.011, lateral=0.0, remaining=0.06)
    assert seen(sounds)


@pytest.mark.long("journey")
def test_the_speaker_is_closed_with_the_window(running, speaker):
    sounds = running[1]
    sounds.close()
    sounds.close()
    assert speaker.is_closed


@pytest.mark.parametrize("kind", list(CueKind))
def test_every_sound_is_short_clean_and_said_in_words(kind):
    cue = Cue(kind, 0.02, 0.5)
    sound = samples(cue).astype(float)
    assert 0.05 < len(sound) / RATE < 0.8
    assert np.abs(sound).max() < 32767.0
    assert np.abs(sound[[0, -1]]).max() < 2000.0
    assert words(cue)


def test_the_nearer_the_target_the_higher_is_the_depth():
    crossings = [
        int((np.diff(np.sign(samples(Cue(CueKind.DEEPER, 0.0, share)))) != 0).sum())
        for share in (0.0, 0.5, 1.0)
    ]
    assert crossings == sorted(set(crossings))


def test_the_mixer_plays_where_there_is_a_sound_card(monkeypatch):
    pytest.importorskip("pygame")
    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")
    mixer = MixerSpeaker()
    mixer.play(Cue(CueKind.BREACH), 0.0)
    mixer.close()
    mixer.close()


@pytest.mark.long("journey")
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_with_sounds_the_program_can_still_be_ended_by_a_signal(number):
    pytest.importorskip("pygame")
    code = (
        "import os, signal, sys, time\n"
        "from app.views.sounds.feature import MixerSpeaker\n"
        "number = int(sys.argv[1])\n"
        "signal.signal(number, signal.SIG_DFL)\n"  # begun in the background it would be ignored
        "speaker = MixerSpeaker()\n"
        "os.kill(os.getpid(), number)\n"
        "time.sleep(5.0)\n"
        "print('still here')\n"
    )
    environment = os.environ | {"SDL_AUDIODRIVER": "dummy"}
    environment.pop("SDL_NO_SIGNAL_HANDLERS", None)
    done = subprocess.run(
        [sys.executable, "-c", code, str(int(number))],
        capture_output=True,
        text=True,
        env=environment,
        timeout=60,
        check=False,
    )
    assert done.returncode != 0
    assert "still here" not in done.stdout

"""How a patient is opened: what it waits for is said."""

import threading

import pytest

from app.core import loading
from app.core.progress import Cancelled, Progress
from app.planning import patient


def test_what_a_patient_waits_for_last_says_that_a_first_start_compiles_and_can_be_cancelled():
    held, done = threading.Event(), threading.Event()

    def hold():
        with loading.ONE_AT_A_TIME:
            held.set()
            done.wait(30)

    def listen(share, text):
        if "first start" in text:
            progress.cancel()

    other = threading.Thread(target=hold)
    other.start()
    held.wait(30)
    progress = Progress(listen)
    with pytest.raises(Cancelled):
        patient._load_verdict(progress)
    done.set()
    other.join()

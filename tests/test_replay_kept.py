"""Records kept from before: one for each force law and effect, recomputed to the last bit.

Made in virtual time with the scripted movement of `test_replay.attempt`, each with one law or one
effect alone. A change of the loop that alters any of their numbers must be meant, and said.
"""

from pathlib import Path

import pytest

from app.compose.trainer import replay_recording
from app.session.recording import read_recording

FOLDER = Path(__file__).parent / "data" / "records-kept"
KEPT = sorted(FOLDER.glob("*.mcap"))


def test_there_is_one_for_each_law_and_effect() -> None:
    assert [path.stem for path in KEPT] == [
        "effect-breathing", "effect-lateral-tissue", "effect-shaft-friction", "law-compensation",
        "law-cone-wall", "law-fixture", "law-forbidden-region", "law-impedance",
    ]  # fmt: skip


@pytest.mark.parametrize("path", KEPT, ids=lambda path: path.stem)
def test_it_is_recomputed_to_the_last_bit_and_forces_acted(path: Path) -> None:
    recording = read_recording(path)
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert report.ticks >= 4000
    assert abs(recording.inputs.column("torque_left")).max() > 1e-3

"""`acus device test`: every command is answered or lost, and a board that falls silent is said."""

import threading
import time

import pytest
from device.wire_process import EmulatorProcess

from app.device.link_test import LinkResult, measure_link
from app.mechanisms.profile import load_profile


def result(**more):
    values = {
        "port": "p", "profile": "icube", "board": "b", "rate_hz": 1000.0, "seconds": 5.0,
        "commands": 5000, "replies": 5000, "lost": 0, "last_answer": 5.0,
        "errors": 0, "late": 0, "missed_deadlines": 0, "board_error": "",
        "round_trip_p50_ms": 0.1, "round_trip_p90_ms": 0.1, "round_trip_p99_ms": 0.1,
        "round_trip_max_ms": 0.1,
    }  # fmt: skip
    return LinkResult(**(values | more))


def test_the_verdict_is_one_plain_sentence():
    assert result().good
    assert not result(lost=1).good
    assert result(lost=21).verdict.startswith("21 of 5000 commands were never answered: check")
    silent = result(lost=2500, last_answer=2.5)
    assert silent.verdict.startswith("the board fell silent 2.50 s after the beginning: 2500 of")


@pytest.mark.long("machine")
@pytest.mark.timeout(300)
@pytest.mark.parametrize(
    ("order", "good"), [("", True), ("cut on", False), ("freeze on", False), ("drop 0.1", False)]
)
def test_replies_and_losses_are_all_commands_whatever_the_board_does(tmp_path, order, good):
    board = EmulatorProcess(tmp_path, "icube", "--hand", "rest")
    try:
        if order:
            halfway = threading.Timer(1.2, board.order, [order])
            halfway.start()
        found = measure_link(board.path, load_profile("icube"), 2.0)
        if order:
            halfway.join()
    finally:
        board._process.stdin.close()
        board._process.wait(20)
        board._process.stdout.close()
        time.sleep(0.1)
    assert found.replies + found.lost == found.commands
    assert found.good is good, found.verdict
    if order in ("cut on", "freeze on"):
        assert "fell silent" in found.verdict
        assert 0.2 < found.last_answer < 1.9

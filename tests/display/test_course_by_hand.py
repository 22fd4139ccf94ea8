"""A course played through by mouse and keyboard, in the real window, on a real CT of a chest.

The instructor makes two exercises, a roster and a course; three students of different skill do
them; the board is looked at and the results leave. Run by `make by-hand`.
"""

from __future__ import annotations

import csv
import os
import time
from pathlib import Path

import numpy as np
import pytest

from app.session.store import list_sessions
from tests.display.user import BY_HAND, User, somebody

CHEST = Path(os.environ.get("ACUS_TEST_DATA", "../shared/data")).resolve() / "ct_chest_lidc0314"

pytestmark = [
    *BY_HAND,
    pytest.mark.skipif(not CHEST.is_dir(), reason="the CT of a chest is not there"),
]

PASSWORD = "correct horse"
FIRST, SECOND = "Right lung with help", "Right lung without help"
STUDENTS = {"ada": "271828", "bob": "314159", "cy": "161803"}
SKILL = {"ada": (1.0, 0.0), "bob": (0.93, 3.0), "cy": (0.7, 12.0)}
"""What share of the way to the path the hand is turned, and how far short it stops [mm]."""

SKIN, LUNG = (-90.0, 46.0), (-80.0, 120.0)
"""On the slice that is shown first, L and P [mm]: skin over the right lung, and a place in it."""

MOST_CLICKS = 40


def test_a_course_is_made_done_and_reported_by_hand(tmp_path: Path) -> None:
    with somebody(tmp_path) as user:
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 60)
        user.press("Not now", "button")
        become_instructor(user, first=True)
        open_chest(user)
        make_exercises(user, tmp_path)
        make_course(user, tmp_path)
        user.menu("Sessions", "Sign out")
        for name in STUDENTS:
            do_course(user, name)
        user.keep_picture("course-08-student-page")
        become_instructor(user)
        report(user, tmp_path)
    check(tmp_path)


def become_instructor(user: User, first: bool = False) -> None:
    user.menu("Sessions", "Sign in as the instructor")
    if first:
        user.write("New password", PASSWORD)
        user.write("Again", PASSWORD)
        user.key("Return")
        user.keep_picture("course-01-recovery-key")
        user.press("Close", "button")  # too early: it asks whether the key is written down
        user.key("space")
        user.press("Close", "button")
    else:
        user.write("Password", PASSWORD)
        user.key("Return")
    time.sleep(1.0)


def open_chest(user: User) -> None:
    user.press("Open CT folder", "button")
    user.choose_file(CHEST)
    user.wait(lambda seen: seen["page"] == "WorkspacePage", "the CT", 60)
    time.sleep(5.0)


def place(user: User, point: tuple[float, float]) -> list[float]:
    """Where a point of the axial slice, L and P [mm], lies on the screen."""
    axial = {name: np.array(at) for name, at in user.see()["axial"].items()}
    return (axial["origin"] + point[0] * axial["left"] + point[1] * axial["back"]).tolist()


def make_exercises(user: User, folder: Path) -> None:
    user.clicks = 0
    user.press("Place  E", "button")
    user.click(place(user, SKIN))
    user.press("Place  T", "button")
    user.click(place(user, LUNG))
    user.clicks += 2
    user.wait(lambda seen: seen["plan"]["reachable"], "a path that the robot can follow", 10)
    user.press("Make an exercise from this", "button")
    user.write("Title", FIRST)
    user.press("Score", "cell")
    user.wait(lambda seen: "20 attempts" in seen["tried"], "what the skills score", 120)
    user.keep_picture("course-02-score")
    user.press("Check and keep", "cell")
    user.keep_picture("course-03-check")
    user.press("Keep", "button", whole=True)
    user.wait(lambda seen: "Kept as" in seen["kept"], "the first exercise", 15)
    assert user.clicks <= MOST_CLICKS
    print(f"a new exercise from an open CT: {user.clicks} clicks")
    user.press("Duplicate", "button")
    user.press("Exercise", "cell")
    user.write("Title", SECOND)
    user.press("Assistance", "cell")
    user.write("Dial at the start", "0", "number")
    user.key("Tab")
    user.keep_picture("course-04-assistance")
    user.press("Keep", "button", whole=True)
    user.wait(lambda seen: "without-help" in seen["kept"], "the second exercise", 15)
    user.key("Escape")
    assert len(list((folder / "exercises").glob("*.yaml"))) == 2


def make_course(user: User, folder: Path) -> None:
    roster = folder / "roster.csv"
    lines = [f"{name},{name.title()} Example,{pin},A" for name, pin in STUDENTS.items()]
    roster.write_text("\n".join(["pseudonym,name,pin,group", *lines]) + "\n", encoding="utf-8")
    user.menu("Sessions", "Progress, students and courses")
    user.press("Students", "tab")
    user.press("Roster from CSV", "button")
    user.choose_file(roster)
    user.wait(lambda seen: "3 students added" in seen["message"], "the roster", 20)
    user.keep_picture("course-05-students")
    user.press("Courses", "tab")
    user.press("New course", "button")
    user.write("File name", "autumn")
    user.write("Title", "Lung, autumn")
    for title in (FIRST, SECOND):
        user.press("Exercise to add", "choice")
        user.press(title, "cell")
        user.press("Add", "button", whole=True)
    user.keep_picture("course-06-course")
    user.press("Save", "button", whole=True)
    user.wait(lambda _: user.find("Lung, autumn", "cell"), "the course", 15)


def do_course(user: User, name: str) -> None:
    user.menu("Sessions", "Sign in as a student")
    user.write("Pseudonym", name)
    user.write("PIN", STUDENTS[name])
    user.key("Return")
    time.sleep(1.5)
    for title in (FIRST, SECOND):
        user.menu("File", "Start page")
        user.wait(lambda seen: seen["page"] == "StartPage", "start page", 10)
        user.press(title, "cell")
        user.press("Begin exercise", "button")
        user.wait(lambda seen: seen["page"] == "BriefingPage", "briefing", 10)
        if name == "ada" and title == FIRST:
            user.keep_picture("course-07-briefing")
        user.key("Return")
        user.wait(lambda seen: seen["state"] == "aligning" and seen["pad"], "attempt", 120)
        insert(user, *SKILL[name])
        user.key("Return")
        user.wait(lambda seen: seen["page"] == "DebriefPage", "debrief", 30)
        time.sleep(1.0)
        user.keep_picture(f"course-07-debrief-{name}-{title.split()[2]}")
    user.menu("Sessions", "Sign out")


def insert(user: User, share: float, short_mm: float) -> None:
    """Turn the hand some share of the way to the path, and stop so far short of the target."""
    for _ in range(3):  # the pad moves the hand half as far as the mouse
        pad = user.see()["pad"]
        user.drag(pad["centre"], 2.0 * share * np.subtract(pad["centre"], pad["hand"]))
        if share < 1.0:
            break
    user.do("mousemove", *user.see()["pad"]["centre"])
    inside = user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 20)
    user.wheel(round(inside["remaining_mm"] - short_mm) - 4)
    time.sleep(1.0)
    inside = user.wait(lambda seen: seen if seen["measured"] else None, "cameras", 20)
    user.wheel(max(0, round(inside["remaining_mm"] - short_mm)))
    time.sleep(1.5)


def report(user: User, folder: Path) -> None:
    user.menu("Sessions", "Progress, students and courses")
    user.press("Progress", "tab")
    user.wait(lambda _: user.find("cy", "cell"), "the board", 20)
    time.sleep(1.0)
    user.keep_picture("course-09-board")
    ada = user.find("ada", "cell")[0]
    cell = next(one for one in user.find("", "cell") if one["row"] == ada["row"] and one["column"])
    user.do("mousemove", *cell["at"], "sleep", 0.2, "click", "--repeat", 2, "--delay", 60, 1)
    time.sleep(1.0)
    user.keep_picture("course-10-curve")
    user.key("Escape")
    user.click(user.find("bob", "cell")[0]["at"])
    forms = ("tidy", "wide", "moodle", "json", "group-pdf", "student-pdf")
    for number, form in enumerate(forms):
        user.press("Form of the results", "choice")
        user.key(*["Up"] * 7, *["Down"] * number, "Return")
        user.press("Export…", "button", whole=True)
        if form in ("moodle", "group-pdf"):  # which attempts make a mark
            user.press("OK", "button", whole=True)
        suffix = form if form == "json" else "pdf" if form.endswith("pdf") else "csv"
        path = folder / f"results-{form}.{suffix}"
        user.choose_file(path)
        user.wait(lambda _, path=path: path.is_file(), f"results, {form}", 20)


def check(folder: Path) -> None:
    summaries = list_sessions(folder / "sessions")
    assert len(summaries) == 6
    assert {one.state for one in summaries} == {"ended"}
    with (folder / "results-wide.csv").open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["pseudonym"] for row in rows] == sorted(STUDENTS)
    best = {
        row["pseudonym"]: [float(value) for key, value in row.items() if key.endswith("best")]
        for row in rows
    }
    print("best points:", best)
    for k in range(2):
        points = [best[name][k] for name in ("cy", "bob", "ada")]
        assert points == sorted(points)
    for name in ("group", "student"):
        assert (folder / f"results-{name}-pdf.pdf").read_bytes().startswith(b"%PDF")
    text = (folder / "results-tidy.csv").read_text(encoding="utf-8-sig")
    assert "Example" not in text  # no name leaves without being asked for

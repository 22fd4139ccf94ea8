"""What a score was made under, in words: one line for page and list, facts for the report."""

from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.views.kit.text import tr


def kind_word(kind: DeviceKind) -> str:
    """Name of what stood behind the needle, for people."""
    return {
        DeviceKind.REAL: tr("real robot"),
        DeviceKind.EMULATED: tr("emulated robot"),
        DeviceKind.SIMULATED: tr("simulated robot"),
        DeviceKind.PEN: tr("pen and webcam"),
        DeviceKind.UNKNOWN: tr("robot not known"),
    }[kind]


def hand_word(conditions: Conditions) -> str:
    """Say what held the needle; empty where it is not known."""
    if conditions.scripted:
        return tr("script ({skill})", skill=conditions.scripted)
    return {
        "mouse": tr("mouse"), "keyboard": tr("keyboard"), "tablet": tr("tablet"),
        "gamepad": tr("gamepad"), "robot": tr("hand at the robot"), "pen": tr("pen"),
        "script": tr("script"),
    }.get(conditions.hand, "")  # fmt: skip


def dial_text(dial: Assistance | None) -> str:
    """Say the dial in short: one number, or its range where it was turned; empty if not known."""
    if dial is None:
        return ""
    if not dial.moved:
        return f"{dial.mean:z.2f}"
    return f"{dial.least:z.2f} … {dial.most:z.2f}"


def short_words(conditions: Conditions | None) -> str:
    """Say hand, robot and assistance in one line; empty where nothing is known."""
    if conditions is None:
        return ""
    dial = dial_text(conditions.assistance)
    parts = (
        hand_word(conditions),
        kind_word(conditions.kind),
        tr("assistance {dial}", dial=dial) if dial else "",
    )
    return "  ·  ".join(filter(None, parts))


def facts_of(conditions: Conditions) -> tuple[tuple[str, str], ...]:
    """Name and value of everything that the score was made under."""
    c = conditions
    return (
        (tr("Exercise"), _exercise(c)),
        (tr("Assistance"), assistance_words(c.assistance)),
        (tr("Views"), _views(c)),
        (tr("Hand and robot"), f"{hand_word(c) or tr('not recorded')}, {_robot(c)}"),
        (tr("Screen and needle"), agreement_words(c)),
        (tr("Software"), _software(c)),
    )


def assistance_words(dial: Assistance | None) -> str:
    """Say what the exercise set, and what it was."""
    if dial is None:
        return tr("not recorded")
    start = tr("not recorded") if dial.start is None else f"{dial.start:z.2f}"
    if not dial.moved and dial.start is not None and abs(dial.mean - dial.start) < 5e-3:
        return tr("{start} as set, throughout", start=start)
    return tr(
        "set {start}; least {least:z.2f}, most {most:z.2f}, over time {mean:z.2f}",
        start=start, least=dial.least, most=dial.most, mean=dial.mean,
    )  # fmt: skip


def agreement_words(conditions: Conditions) -> str:
    """Say how well screen and needle agreed, and by which calibration of the cameras."""
    if conditions.kind is DeviceKind.SIMULATED:
        return tr("simulated cameras")
    calibration = (
        tr("calibration {id}", id=conditions.calibration)
        if conditions.calibration
        else tr("no calibration")
    )
    if conditions.agreement_mm is None:
        return tr("not checked; {calibration}", calibration=calibration)
    return tr(
        "agree within {mm:.1f} mm (95 %); {calibration}",
        mm=conditions.agreement_mm, calibration=calibration,
    )  # fmt: skip


def _exercise(c: Conditions) -> str:
    version = tr("version {n}", n=c.version) if c.version else tr("version not recorded")
    level = tr("level {n}", n=c.level) if c.level else ""
    return ", ".join(filter(None, (c.exercise, version, level)))


def _views(c: Conditions) -> str:
    if c.views is None:
        return tr("not recorded")
    return ", ".join(view.replace("_", " ") for view in c.views) or tr("none")


def _robot(c: Conditions) -> str:
    return f"{kind_word(c.kind)} ({c.device})" if c.device else kind_word(c.kind)


def _software(c: Conditions) -> str:
    parts = (
        f"Acus {c.software}" if c.software else "",
        tr("scoring version {n}", n=c.scoring_version) if c.scoring_version else "",
        tr("seed {n}", n=c.seed) if c.seed is not None else "",
    )
    return ", ".join(filter(None, parts))

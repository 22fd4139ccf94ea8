"""Write what the hardware kit takes from the profiles: `python -m tools.kit [--stl] [--pictures]`.

`kit/` holds the parts of a needle pantograph as OpenSCAD sources. Their numbers are those of the
device, the rig and the plate for the registration, and the kit's own (`kit/kit.yaml`); this tool
writes them to out/kit/profile.scad, tables and the wiring's drawing to docs. `--stl` and
`--pictures` run `openscad`, which finds that file by OPENSCADPATH.
"""

from __future__ import annotations

import argparse
import csv
import os
import re
import subprocess
from collections.abc import Iterable, Mapping
from html import escape
from math import atan2, cos, degrees, radians
from pathlib import Path
from typing import Any, Final

from app.core.configuration import parse_yaml
from app.mechanisms.pantograph.profile import PantographProfile, load_pantograph
from app.planning.registration.plate import FiducialPlate, load_plate
from app.tracking.optics.rig import RigProfile, load_rig

ROOT: Final = Path(__file__).resolve().parents[1]
KIT: Final = ROOT / "kit"
OUT: Final = ROOT / "out" / "kit"
PAGE: Final = ROOT / "docs" / "kit.md"
DRAWING: Final = ROOT / "docs" / "pictures" / "kit-wiring.svg"
PICTURE: Final = ROOT / "docs" / "pictures" / "kit.png"
PARTS: Final = {  # what is printed, and how often
    "base": 1,
    "proximal": 2,
    "distal": 2,
    "ball_cage": 4,
    "ball": 2,
    "fulcrum": 1,
    "skin_frame": 2,
    "axis_jig": 1,
    "plate": 1,
    "camera_foot": 2,
    "camera_head": 2,
    "marker_gauge": 1,
}


def numbers(device: PantographProfile, rig: RigProfile, plate: FiducialPlate) -> dict[str, Any]:
    """Return what the sources read, by name: lengths [mm], angles [deg]; the kit's own last."""
    lengths, needle = device.geometry, rig.needle
    found = {
        "proximal": lengths.proximal * 1e3,
        "distal": lengths.distal * 1e3,
        "base": lengths.base * 1e3,
        "fulcrum": [1e3 * value for value in lengths.fulcrum],
        "needle_length": lengths.needle_length * 1e3,
        "home": [degrees(angle) for angle in device.encoder.home_offsets],
        "tilt_limit": device.tilt_limit_deg,
        "gear": device.inertia.gear,
        "shaft_diameter": needle.shaft_diameter_mm,
        "point_length": needle.point_length_mm,
        "marker_offset": needle.marker_offset_mm,
        "marker_length": needle.marker_length_mm,
        "cameras": [list(camera.position_mm) for camera in rig.cameras],
        "looks_at": [list(camera.looks_at_mm) for camera in rig.cameras],
        "fiducials": [
            [list(one.touch_mm), list(one.bead_mm)] for one in plate.fiducials if one.bead_mm
        ],
        "bead_diameter": plate.bead_diameter_mm,
    }
    own: dict[str, float] = parse_yaml((KIT / "kit.yaml").read_text(encoding="utf-8"), "kit.yaml")
    return found | own


def scad(values: Mapping[str, Any]) -> str:
    """Return the numbers as OpenSCAD reads them."""
    head = "// written by python -m tools.kit; do not edit\n"
    return head + "".join(f"{name} = {_shown(value)};\n" for name, value in values.items())


def _shown(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_shown, value))}]"
    return f"{value:.10g}"


def cuts(k: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Return what is cut, turned or bought to a measure that follows from the profiles."""
    height, rail = k["fulcrum"][2], k["rail"]
    cage = k["bearing_width"] + k["cage_flange_height"]
    pulley = (k["drum_diameter"] + k["cable_diameter"]) / k["gear"] - k["cable_diameter"]
    apart = (k["drum_diameter"] + pulley) / 2 + k["cable_diameter"]
    bridge = height - k["bearing_width"] - rail  # underside of the rail that carries the fulcrum
    tube = height / cos(radians(k["tilt_limit"])) + 2 * cage
    posts = (
        f"{bridge - k['board_top']:.0f} mm at x = ±{k['bridge_half']:g}, y = {k['bridge_y']:g} mm"
    )
    rows: list[tuple[str, ...]] = [
        ("pulley, turned of steel", f"{pulley:.2f} mm outside, {k['motor_shaft']:g} mm bore"),
        ("axis of motor to axis of link", f"{apart:.2f} mm"),
        ("rail that carries the fulcrum", f"{2 * k['bridge_half'] + rail:.0f} mm"),
        ("its two posts", posts),
        ("tube", f"{tube:.0f} mm, inside {k['shaft_diameter'] + k['tube_play']:g} mm"),
        ("needle", f"{k['needle_length']:g} mm from hub to tip"),
    ]
    for (x, y, z), aim in zip(k["cameras"], k["looks_at"], strict=True):
        post = z - (k["camera_holes"] / 2 + 4) - 7 - k["board_top"]
        turn = degrees(atan2(aim[1] - y, aim[0] - x))
        place = f"{post:.0f} mm at x = {x:g}, y = {y:g} mm, turned to {turn:.1f}°"
        rows.append(("post of a camera", place))
    return rows


def lens_mm(rig: RigProfile, pixel_um: float) -> float:
    """Return the focal length of the rig's lenses [mm], by the sensor's pixel."""
    return rig.cameras[0].focal_px[0] * pixel_um * 1e-3


def currents(device: PantographProfile, constant: float) -> list[tuple[str, str, str]]:
    """Return joint torques and the motor currents that they need, for a motor [N·m/A]."""
    largest = device.limits.joint_torque
    share = 0.8  # of the PWM's range that is between both ends
    rows = [("the shipped limit", largest), ("5 N everywhere (docs/mechanism.md)", 1.25)]
    return [
        (name, f"{torque:g} N·m", f"{torque / (device.gear * constant):.2f} A")
        for name, torque in rows
    ] + [
        (
            f"2.5 % of the PWM, ±{most:g} A set",
            f"{0.025 / share * 2 * most * constant * device.gear:.2f} N·m",
            f"{0.025 / share * 2 * most:.2f} A",
        )
        for most in (device.motor.largest_current, 4.0)
    ]


def motor_constant() -> float:
    """Return the torque constant of the first motor in kit/parts.csv [N·m/A]."""
    stated = re.search(r"([\d.]+) mN·m/A", (KIT / "parts.csv").read_text(encoding="utf-8"))
    if stated is None:
        raise ValueError("kit/parts.csv: no motor states its mN·m/A")
    return 1e-3 * float(stated[1])


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Return a table as the pages write it."""
    names = list(head)
    lines = [names, ["---"] * len(names), *(list(row) for row in rows)]
    return "\n".join(f"| {' | '.join(cell.replace('|', '/') for cell in line)} |" for line in lines)


def _of_csv(name: str) -> str:
    rows = list(csv.reader((KIT / name).read_text(encoding="utf-8").splitlines()))
    return table(rows[0], rows[1:])


def wiring() -> list[dict[str, str]]:
    """Return the board's pins, a row of kit/wiring.csv each."""
    with (KIT / "wiring.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def drawing(rows: Iterable[Mapping[str, str]]) -> str:
    """Return the wiring as SVG: the board's pins on the left, what each joins on the right."""
    pins = list(rows)
    ends = list(dict.fromkeys(row["joins"] for row in pins))
    height, width = 28 * len(pins) + 60, 900
    at = {end: (k + 0.5) / len(ends) * (height - 40) + 30 for k, end in enumerate(ends)}
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}"'
        ' font-family="sans-serif" font-size="13">',
        '<rect width="100%" height="100%" fill="white"/>',
        f'<rect x="20" y="20" width="230" height="{height - 40}" rx="6" fill="#e8eef2"'
        ' stroke="#345"/>',
        '<text x="30" y="38" font-weight="bold">board, STM32F405</text>',
    ]
    for k, row in enumerate(pins):
        y, end = 60 + 28 * k, at[row["joins"]]
        lines += [
            f'<path d="M250 {y} C 400 {y}, 400 {end:.0f}, 540 {end:.0f}" fill="none"'
            ' stroke="#678"/>',
            f'<text x="30" y="{y + 4}"><tspan font-weight="bold">{row["pin"]}</tspan>'
            f" {escape(row['signal'])}</text>",
            f'<text x="258" y="{y - 4}" font-size="10" fill="#456">{escape(row["by"])}</text>',
        ]
    for name, middle in at.items():
        lines += [
            f'<rect x="540" y="{middle - 12:.0f}" width="340" height="24" rx="4" fill="#f4efe4"'
            ' stroke="#864"/>',
            f'<text x="550" y="{middle + 4:.0f}">{escape(name)}</text>',
        ]
    return "\n".join([*lines, "</svg>"]) + "\n"


def written(page: str, rig: RigProfile, device: PantographProfile, k: Mapping[str, Any]) -> str:
    """Return the page with its tables made anew: each stands between two comments of its name."""
    lens = f"{lens_mm(rig, k['camera_pixel_um']):.1f} mm, for pixels of {k['camera_pixel_um']:g} µm"
    tables = {
        "parts": _of_csv("parts.csv"),
        "wiring": _of_csv("wiring.csv"),
        "printed": table(
            ("source", "printed"), ((f"`{n}.scad`", str(c)) for n, c in PARTS.items())
        ),
        "cuts": table(("part", "measure"), [*cuts(k), ("lens of a camera", lens)]),
        "currents": table(
            ("for", "at the joint", "at the motor"), currents(device, motor_constant())
        ),
    }
    for name, text in tables.items():
        before, begin, rest = page.partition(f"<!-- {name}: written by python -m tools.kit -->\n")
        _, end, after = rest.partition(f"<!-- end of {name} -->")
        if not begin or not end:
            raise ValueError(f"{PAGE}: the comments around table {name!r} are not there")
        page = f"{before}{begin}{text}\n{end}{after}"
    return page


def openscad(part: str, target: Path, folder: Path, *options: str) -> None:
    """Let OpenSCAD make a part's STL or picture; profile.scad lies in `folder`.

    Raises:
        subprocess.CalledProcessError: what it printed is in `stderr`.
    """
    own = os.environ | {"OPENSCADPATH": str(folder)}
    command = ["openscad", "--hardwarnings", "-o", str(target), *options, str(KIT / f"{part}.scad")]
    subprocess.run(command, check=True, env=own, capture_output=True, text=True)


def main() -> None:
    """Write the numbers, the page's tables and the drawing; parts and pictures where asked."""
    parser = argparse.ArgumentParser(prog="python -m tools.kit")
    parser.add_argument("--device", default="icube", help="device profile: name or path")
    parser.add_argument("--rig", default="wide", help="rig profile: name or path")
    parser.add_argument("--plate", default="stepped-plate", help="plate: name or path")
    parser.add_argument("--stl", action="store_true", help="print files of all parts")
    parser.add_argument("--pictures", action="store_true", help="a picture of each part")
    chosen = parser.parse_args()
    device, rig = load_pantograph(chosen.device), load_rig(chosen.rig)
    k = numbers(device, rig, load_plate(chosen.plate))
    OUT.mkdir(parents=True, exist_ok=True)
    (OUT / "profile.scad").write_text(scad(k), encoding="utf-8")
    print(f"wrote {OUT / 'profile.scad'}")
    if parser.get_default("device") == chosen.device and parser.get_default("rig") == chosen.rig:
        page = written(PAGE.read_text(encoding="utf-8"), rig, device, k)
        PAGE.write_text(page, encoding="utf-8")
        DRAWING.write_text(drawing(wiring()), encoding="utf-8")
        print(f"wrote {PAGE}, {DRAWING}")
    for part in PARTS:
        for index in range(2 if part.startswith("camera") else 1):
            name = f"{part}-{index}" if part.startswith("camera") else part
            option = ["-D", f"camera={index}"] if part.startswith("camera") else []
            if chosen.stl:
                openscad(part, OUT / f"{name}.stl", OUT, "--export-format", "binstl", *option)
            if chosen.pictures:
                view = ["--render", "--viewall", "--autocenter", "--imgsize", "800,600"]
                openscad(part, OUT / f"{name}.png", OUT, *view, *option)
    if chosen.pictures:  # not --render: a rendered one has no colours
        view = ["--camera", "0,110,90,62,0,28,1500", "--imgsize", "1200,800"]
        openscad("assembly", PICTURE, OUT, "--colorscheme", "Tomorrow", *view)


if __name__ == "__main__":
    main()

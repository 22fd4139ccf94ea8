"""The hardware kit: parts measured against the profiles, pins against the firmware and ST's table.

The print files are made by OpenSCAD and read, cut and measured by VTK: neither knows our numbers,
and what is found (every circle of a cut) is found without being told where to look.
"""

import os
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
import yaml

from app.core import paths
from tools import kit

ROOT = Path(__file__).resolve().parents[1]
FACETS = 24


def profile(folder, name):
    return yaml.safe_load((paths.resources() / folder / f"{name}.yaml").read_text("utf-8"))


ICUBE, WIDE = profile("devices", "icube"), profile("cameras", "wide")
PLATE, OWN = (
    profile("fiducials", "stepped-plate"),
    yaml.safe_load((kit.KIT / "kit.yaml").read_text()),
)


@pytest.fixture(scope="module")
def printed(tmp_path_factory):
    """Make a part once and return it as VTK reads it."""
    if shutil.which("openscad") is None:
        if os.environ.get("CI") == "true":
            pytest.fail("openscad is missing: tools/install-system tests")
        pytest.skip("openscad is not installed: tools/install-system tests")
    readers = pytest.importorskip("vtkmodules.vtkIOGeometry")
    folder = tmp_path_factory.mktemp("kit")
    values = kit.numbers(
        kit.load_pantograph("icube"), kit.load_rig("wide"), kit.load_plate("stepped-plate")
    )
    (folder / "profile.scad").write_text(kit.scad(values), encoding="utf-8")
    made = {}

    def make(part, camera=0):
        if (part, camera) not in made:
            target = folder / f"{part}-{camera}.stl"
            few = ("-D", f"facets={FACETS}", "-D", f"camera={camera}")
            kit.openscad(part, target, folder, "--export-format", "binstl", *few)
            reader = readers.vtkSTLReader()
            reader.SetFileName(str(target))
            reader.Update()
            made[part, camera] = reader.GetOutput()
        return made[part, camera]

    return make


def box(mesh):
    """Bounds of a mesh: (lowest, highest), each of shape (3,) [mm]."""
    bounds = np.array(mesh.GetBounds())
    return bounds[0::2], bounds[1::2]


def loops(mesh, height):
    """Closed lines of the cut at a height, each of shape (n, 2) [mm]."""
    from vtkmodules.vtkCommonDataModel import vtkPlane
    from vtkmodules.vtkFiltersCore import vtkCutter, vtkStripper

    plane = vtkPlane()
    plane.SetNormal(0.0, 0.0, 1.0)
    plane.SetOrigin(0.0, 0.0, height)
    cutter, stripper = vtkCutter(), vtkStripper()
    cutter.SetCutFunction(plane)
    cutter.SetInputData(mesh)
    stripper.SetInputConnection(cutter.GetOutputPort())
    stripper.JoinContiguousSegmentsOn()
    stripper.Update()
    cut = stripper.GetOutput()
    points = np.array([cut.GetPoint(k) for k in range(cut.GetNumberOfPoints())])
    found = []
    for k in range(cut.GetNumberOfCells()):
        line = cut.GetCell(k).GetPointIds()  # the same object for each cell
        found.append(points[[line.GetId(j) for j in range(line.GetNumberOfIds())], :2])
    return found


def circles(mesh, height):
    """Every round line of a cut: (x, y, diameter) [mm], by least squares of its points."""
    found = []
    for line in loops(mesh, height):
        least = np.column_stack([2 * line, np.ones(len(line))])
        x, y, c = np.linalg.lstsq(least, (line**2).sum(axis=1), rcond=None)[0]
        radius = np.sqrt(c + x * x + y * y)
        off = np.abs(np.hypot(line[:, 0] - x, line[:, 1] - y) - radius)
        # The cut adds points on the triangles' edges, which lie on the chords.
        if off.max() < 1.1 * radius * (1 - np.cos(np.pi / FACETS)):
            found.append((x, y, 2 * np.hypot(line[:, 0] - x, line[:, 1] - y).max()))
    return found


def centres(mesh, height, diameter):
    """Middles of the circles of a diameter, shape (n, 2), by x."""
    found = [(x, y) for x, y, wide in circles(mesh, height) if abs(wide - diameter) < 0.02]
    return np.array(sorted(found))


@pytest.mark.long("journey")
def test_the_links_holes_stand_as_far_apart_as_the_profiles_lengths(printed):
    width, seat = OWN["bearing_width"], OWN["bearing_outer"]
    proximal, distal = printed("proximal"), printed("distal")
    top = box(proximal)[1][2]
    (axis,) = centres(proximal, top - width / 2, seat)
    (elbow,) = centres(proximal, top - width / 2, OWN["bearing_bore"])
    assert np.hypot(*(elbow - axis)) == pytest.approx(1e3 * ICUBE["geometry"]["proximal"], abs=0.02)
    (elbow,) = centres(distal, width / 2, seat)
    (tool,) = centres(distal, width / 2, OWN["cage_bearing_outer"])
    assert np.hypot(*(tool - elbow)) == pytest.approx(1e3 * ICUBE["geometry"]["distal"], abs=0.02)
    outer = max(wide for _, _, wide in circles(proximal, width / 2))
    assert outer == pytest.approx(OWN["drum_diameter"], abs=0.02)


@pytest.mark.long("journey")
def test_base_and_jig_hold_the_axes_and_the_fulcrum_where_the_profile_says(printed):
    half, (x, y, height) = 500.0 * ICUBE["geometry"]["base"], ICUBE["geometry"]["fulcrum"]
    base, jig = printed("base"), printed("axis_jig")
    axes = centres(base, -OWN["base_thickness"] / 2, OWN["bearing_bore"])
    assert axes == pytest.approx(np.array([[-half, 0.0], [half, 0.0]]), abs=0.02)
    low, high = box(jig)
    axes = centres(jig, low[2] + 5.0, OWN["bearing_bore"] + OWN["clearance"] / 2)
    assert axes == pytest.approx(np.array([[-half, 0.0], [half, 0.0]]), abs=0.02)
    (needle,) = centres(jig, high[2] - 5.0, OWN["tube_outer"] + OWN["clearance"])
    assert needle == pytest.approx(1e3 * np.array([x, y]), abs=0.02)
    cage = box(printed("ball_cage"))[1][2]
    assert high[2] + cage == pytest.approx(1e3 * height, abs=0.01)  # what the jig carries


@pytest.mark.long("journey")
def test_a_link_lies_against_its_stop_at_the_home_angle(printed):
    """Outlines of link and post, put together by the profile's angle, touch and do not overlap."""
    base, link = printed("base"), printed("proximal")
    arm = max(loops(link, box(link)[1][2] - 3.0), key=lambda line: np.ptp(line[:, 0]))
    posts = centres(base, 20.0, OWN["stop_diameter"])
    dense = np.concatenate(
        [np.linspace(a, b, 200) for a, b in zip(arm, np.roll(arm, -1, axis=0), strict=True)]
    )
    for side, angle, post in zip((-1, 1), ICUBE["encoder"]["home_offsets"], posts, strict=True):
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        placed = dense @ turn.T + [500.0 * side * ICUBE["geometry"]["base"], 0.0]
        gap = np.hypot(*(placed - post).T).min() - OWN["stop_diameter"] / 2
        assert gap == pytest.approx(0.0, abs=0.15)  # a circle of 24 pieces
        across = np.array([-np.sin(angle), np.cos(angle)]) @ (post - placed.mean(axis=0))
        assert np.sign(across) == -side  # left is turned counter-clockwise against its post


@pytest.mark.long("journey")
def test_a_tube_may_lean_in_the_cage_as_far_as_the_ball_joint_allows(printed):
    cage, tilt = printed("ball_cage"), np.radians(ICUBE["workspace"]["tilt_limit_deg"]["new"])
    top, radius = box(cage)[1][2], OWN["tube_outer"] / 2
    for height in np.linspace(OWN["ball_lip"] + 0.1, top - 0.1, 5):
        inner = min(circles(cage, height), key=lambda one: abs(one[0]) + abs(one[1]) + one[2] / 9)
        free = height * np.tan(tilt) + radius / np.cos(tilt)
        assert inner[2] / 2 == pytest.approx(free, abs=0.05)
    least = min(wide for _, _, wide in circles(cage, OWN["ball_lip"] + 0.02) if wide > 10)
    ball = 2 * np.sqrt((OWN["ball_diameter"] / 2) ** 2 - OWN["ball_lip"] ** 2)
    assert least < ball - 1.0  # narrower than the ball there, which stays in


@pytest.mark.long("journey")
def test_the_plates_pits_and_beads_are_those_of_its_file(printed):
    plate = printed("plate")
    wanted = sorted(tuple(one["touch_mm"]) for one in PLATE["fiducials"])
    beads = centres(plate, 10.0, PLATE["bead_diameter_mm"] + OWN["clearance"])
    assert beads == pytest.approx(np.array([one[:2] for one in wanted]), abs=0.02)
    points = np.array([plate.GetPoint(k) for k in range(plate.GetNumberOfPoints())])
    for touch in wanted:
        assert np.linalg.norm(points - touch, axis=1).min() < 0.01  # the bottom of a pit
    assert box(plate)[1][2] == pytest.approx(max(one[2] for one in wanted) + 3.0, abs=0.01)


@pytest.mark.long("journey")
@pytest.mark.parametrize("camera", [0, 1])
def test_a_cameras_foot_turns_its_post_to_where_the_rig_looks(printed, camera):
    one = WIDE["cameras"][camera]
    line = np.array(one["looks_at_mm"]) - one["position_mm"]
    (inner,) = (
        loop for loop in loops(printed("camera_foot", camera), 5.0) if np.ptp(loop[:, 0]) < 50
        and np.ptp(loop[:, 0]) > 15
    )  # fmt: skip
    corner = inner[np.argmax(inner[:, 0])]
    found = np.degrees(np.arctan2(corner[1], corner[0]))
    azimuth = np.degrees(np.arctan2(line[1], line[0]))
    assert (found - azimuth - 45.0 + 45.0) % 90.0 == pytest.approx(45.0, abs=0.1)


@pytest.mark.long("journey")
def test_the_gauges_window_is_the_marker_and_the_jigs_needle_fits(printed):
    gauge, needle = printed("marker_gauge"), WIDE["needle"]
    bore = needle["shaft_diameter_mm"] + OWN["clearance"]
    cuts = {z: circles(gauge, z) for z in np.arange(0.25, 38.0, 0.5)}
    ground = (
        min(z for z, found in cuts.items() if any(abs(c[2] - bore) < 0.02 for c in found)) - 0.25
    )
    window = [z - ground for z, found in cuts.items() if not found]  # no closed circle is left
    low = needle["marker_offset_mm"] - needle["marker_length_mm"] / 2
    assert min(window) - 0.25 == pytest.approx(low, abs=0.01)
    assert max(window) + 0.25 == pytest.approx(low + needle["marker_length_mm"], abs=0.01)


@pytest.mark.long("journey")
@pytest.mark.parametrize("part", ["fulcrum", "skin_frame", "camera_head", "ball"])
def test_the_other_parts_are_closed_and_of_their_size(printed, part):
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges

    edges = vtkFeatureEdges()
    edges.SetInputData(printed(part))
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    assert edges.GetOutput().GetNumberOfCells() == 0  # no edge is open or shared by three
    low, high = box(printed(part))
    assert (high - low).max() < 220.0  # fits a usual printer
    if part == "ball":
        assert (high - low)[:2] == pytest.approx(OWN["ball_diameter"], abs=0.05)


def test_the_gear_is_that_of_the_cables_middle():
    values = kit.numbers(
        kit.load_pantograph("icube"), kit.load_rig("wide"), kit.load_plate("stepped-plate")
    )
    outside = float(dict(kit.cuts(values)[:1])["pulley, turned of steel"].split(" mm")[0])
    drum, cable = OWN["drum_diameter"], OWN["cable_diameter"]
    assert (drum + cable) / (outside + cable) == pytest.approx(ICUBE["inertia"]["gear"], rel=1e-3)


ALTERNATES = {  # ST DocID022152, table 9
    ("PB6", 7): "USART1 TX", ("PB7", 7): "USART1 RX",
    ("PA8", 1): "TIM1 CH1", ("PA9", 1): "TIM1 CH2", ("PA10", 1): "TIM1 CH3",
    ("PC6", 3): "TIM8 CH1", ("PC7", 3): "TIM8 CH2", ("PC8", 3): "TIM8 CH3",
    ("PA6", 2): "TIM3 CH1", ("PA7", 2): "TIM3 CH2",
}  # fmt: skip
PORTS = {"A": 0x40020000, "B": 0x40020400, "C": 0x40020800}

MAIN = r"""
#include <stdio.h>
static uint32_t memory[0x10000];
static volatile uint32_t *at(uint32_t address) { return &memory[(address >> 2) & 0xFFFFU]; }
int main(void)
{
    static const uint32_t ports[3] = {GPIOA, GPIOB, GPIOC};
    set_pins();
    for (unsigned p = 0; p < 3; p++) {
        for (unsigned pin = 0; pin < 16; pin++) {
            printf("%c %u %u %u %u\n", 'A' + p, pin,
                   (unsigned)(GPIO_MODER(ports[p]) >> (2 * pin)) & 3U,
                   (unsigned)(GPIO_AFR(ports[p], pin) >> (4 * (pin % 8))) & 15U,
                   (unsigned)(GPIO_PUPDR(ports[p]) >> (2 * pin)) & 3U);
        }
    }
    return 0;
}
"""


def test_the_wiring_is_what_the_firmware_sets_its_pins_to(tmp_path):
    """The firmware's own `set_pins` runs here on memory that stands in for the chip's registers."""
    if shutil.which("gcc") is None:
        pytest.skip("gcc is not installed: tools/install-system tests")
    source = ROOT / "firmware" / "ports" / "stm32f405"
    headers = (source / "registers.h").read_text()
    real = "#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))"
    assert real in headers
    for port, address in PORTS.items():
        assert f"#define GPIO{port} 0x{address:08X}U" in headers  # RM0090, 2.3
    ours = "static volatile uint32_t *at(uint32_t address);\n#define REG(address) (*at(address))"
    (tmp_path / "registers.h").write_text(headers.replace(real, ours))
    text = re.sub(r"__asm volatile\(.*?\);", ";", (source / "port.c").read_text())
    (tmp_path / "device.h").write_text((ROOT / "firmware/devices/icube.h").read_text())
    body = text[: text.index("static void set_encoder")]
    (tmp_path / "pins.c").write_text(body + MAIN)
    includes = [tmp_path, ROOT / "firmware" / "core"]
    program = tmp_path / "pins"
    subprocess.run(
        ["gcc", "-std=c11", "-w", *(f"-I{one}" for one in includes), "-o", program,
         tmp_path / "pins.c"],
        check=True,
    )  # fmt: skip
    printed = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    found = {}
    for line in printed.splitlines():
        port, pin, mode, function, pull = line.split()
        name = f"P{port}{pin}"
        if mode == "2":
            found[name] = ALTERNATES[name, int(function)]
        elif mode == "1":
            found[name] = "output"
        elif mode == "3":
            found[name] = f"ADC1 IN{pin}"  # PA0 to PA7 are the channels 0 to 7
        elif pull == "2":
            found[name] = "input with pull-down"
    assert {row["pin"]: row["function"] for row in kit.wiring()} == found


def test_each_signal_goes_to_the_pin_that_the_ports_comment_names():
    comment = (ROOT / "firmware/ports/stm32f405/port.c").read_text().split("*/")[0]
    stated = re.findall(r"^ \*   ((?:P[A-C]\d+(?:, )?)+) +(\S.*)", comment, flags=re.M)
    pins = [pin for names, _ in stated for pin in names.split(", ")]
    rows = {row["pin"]: row for row in kit.wiring()}
    assert sorted(pins) == sorted(rows)
    for names, meaning in stated:
        for pin, side in zip(names.split(", "), ("left", "right"), strict=False):
            if "left and right" in meaning:
                assert rows[pin]["signal"].startswith(side)
            elif meaning.startswith(("left", "right")):
                assert rows[pin]["signal"].startswith(meaning.split()[0])


def test_the_page_shows_the_tables_and_the_drawing_as_they_are_now():
    page = kit.PAGE.read_text(encoding="utf-8")
    device, rig = kit.load_pantograph("icube"), kit.load_rig("wide")
    values = kit.numbers(device, rig, kit.load_plate("stepped-plate"))
    assert kit.written(page, rig, device, values) == page, "run python -m tools.kit"
    assert kit.drawing(kit.wiring()) == kit.DRAWING.read_text(encoding="utf-8")


def test_every_source_is_printed_or_named_and_writes_no_number_of_a_profile():
    sources = {file.stem for file in kit.KIT.glob("*.scad")}
    assert sources == {*kit.PARTS, "common", "assembly"}
    lengths = {100.0, 165.0, 85.0, 160.56, 90.0, 200.0, 270.0, 482.3, 420.0}
    for file in kit.KIT.glob("*.scad"):
        code = re.sub(r"//.*|rotate\([^()]*\)", "", file.read_text(encoding="utf-8"))
        numbers = {float(one) for one in re.findall(r"(?<![\w.])\d+(?:\.\d+)?", code)}
        assert not (numbers & lengths) - {90.0}, file.name

"""URDF out and in: the loop cut as the laboratory cuts it, lengths back, bad files named."""

import os
import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.errors import AcusError, ConfigurationError
from app.exchange.errors import ExportError, UrdfError
from app.exchange.text_export import write_text
from app.exchange.urdf import Origin, profile_like, read_geometry, write_urdf
from app.mechanisms.errors import MechanismError
from app.mechanisms.pantograph import forward, inverse, passive_angles
from app.mechanisms.pantograph.profile import load_pantograph
from app.mechanisms.profile import load_profile, profile_names

PROFILE = load_profile("icube")
RUN = CliRunner()

JOINTS = {
    "panto_base_to_fulcrum": "0.0425 0.16056 0.09",
    "panto_a1": "0.0 0 0",
    "panto_a2": "0.1 0 0",
    "panto_a3": "0.165 0 0",
    "panto_a5": "0.085 0 0",
    "panto_a4": "0.1 0 0",
}


def description(joints: dict[str, str], cylinder: str = "0.2", head: str = "") -> str:
    """A description as the laboratory's: a xacro macro whose numbers are literal."""
    lines = [
        f'<joint name="{name}" type="revolute"><parent link="a"/><child link="b"/>'
        f'<origin xyz = "{xyz}" rpy="0 0 0"/></joint>'
        for name, xyz in joints.items()
    ]
    needle = (
        f'<visual><geometry><cylinder length = "{cylinder}" radius="0.0025"/></geometry></visual>'
    )
    return (
        f'<?xml version="1.0"?>{head}<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
        f'<xacro:macro name="pantograph" params="parent *origin">{"".join(lines)}'
        '<joint name="panto_root_joint" type="fixed"><xacro:insert_block name="origin"/>'
        '<parent link="${parent}"/><child link="panto_base"/></joint>'
        f'<link name="tool_phi_link">{needle}</link></xacro:macro></robot>'
    )


def written(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "robot.urdf.xacro"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_laboratorys_description_gives_the_shipped_lengths(tmp_path):
    found = read_geometry(written(tmp_path, description(JOINTS)))
    for name in ("proximal", "distal", "base", "fulcrum", "needle_length"):
        assert getattr(found, name) == pytest.approx(getattr(PROFILE.geometry, name), abs=1e-15)
        assert found.provenance[name].value == "imported"


def test_an_origin_midway_between_the_motors_gives_the_same(tmp_path):
    centred = JOINTS | {
        "panto_a1": "-0.0425 0 0",
        "panto_a5": "0.0425 0 0",
        "panto_base_to_fulcrum": "0 0.16056 0.09",
    }
    found = read_geometry(written(tmp_path, description(centred)))
    assert found.fulcrum == pytest.approx(PROFILE.geometry.fulcrum, abs=1e-15)
    assert found.base == pytest.approx(0.085, abs=1e-15)


@pytest.mark.parametrize(
    "name", [name for name in profile_names() if load_profile(name).kind == "pantograph"]
)
@pytest.mark.parametrize("origin", list(Origin))
def test_what_is_exported_comes_back(tmp_path, name, origin):
    profile = load_profile(name)
    path = written(tmp_path, write_urdf(profile, origin))
    found = read_geometry(path)
    for field in ("proximal", "distal", "base", "fulcrum", "needle_length"):
        assert getattr(found, field) == pytest.approx(getattr(profile.geometry, field), abs=1e-15)


@pytest.mark.parametrize("origin", list(Origin))
def test_the_exported_tree_closes_at_the_tool_in_mujoco(origin):
    """MuJoCo reads the URDF: with our passive angles both arms end at P3, shifted by the origin."""
    model = mujoco.MjModel.from_xml_string(_for_mujoco(write_urdf(PROFILE, origin)))
    data, geometry = mujoco.MjData(model), PROFILE.pantograph
    shift = 0.5 * geometry.base if origin is Origin.LEFT_MOTOR else 0.0
    for p3 in ((0.0, 0.16056), (0.05, 0.18), (-0.06, 0.13)):
        q = inverse(geometry, p3)
        passive = passive_angles(geometry, q)
        angles = {"panto_a1": q[0], "panto_a5": q[1]}
        angles |= {"panto_a2": passive.left_relative, "panto_a4": passive.right_relative}
        for joint, angle in angles.items():
            data.qpos[model.joint(joint).qposadr[0]] = angle
        mujoco.mj_kinematics(model, data)
        expected = [*(forward(geometry, q) + [shift, 0.0]), 0.0]
        for body in ("panto_tool0", "panto_right_end"):
            assert data.body(body).xpos == pytest.approx(expected, abs=1e-15)


def test_a_thousand_poses_are_those_of_pinocchio_s_tree():
    """Pinocchio reads the URDF; its needle is where ours is, to 1e-9 m, hub and direction too."""
    pinocchio = pytest.importorskip("pinocchio", reason="the extra `arm` is not installed")
    model = pinocchio.buildModelFromXML(write_urdf(PROFILE, Origin.MIDPOINT))
    data = model.createData()
    place = {name: model.joints[model.getJointId(name)].idx_q for name in model.names[1:]}
    worst = 0.0
    for angles, tool, hub, up in _thousand_poses():
        values = np.zeros(model.nq)
        for name, angle in angles.items():
            values[place[name]] = angle
        pinocchio.framesForwardKinematics(model, data, values)
        frames = {name: data.oMf[model.getFrameId(name)] for name in FRAMES}
        worst = max(
            worst,
            np.abs(frames["panto_tool0"].translation - tool).max(),
            np.abs(frames["panto_right_end"].translation - tool).max(),
            np.abs(frames["needle_interaction_link"].translation - hub).max(),
            np.abs(frames["needle_interaction_link"].rotation[:, 2] - up).max(),
        )
    assert worst < 1e-9


def _thousand_poses():
    """Angles by joint, and where tool and hub are then [m] and the needle's direction upwards."""
    geometry, rng = PROFILE.pantograph, np.random.default_rng(7)
    for _ in range(1000):
        lean, turn = PROFILE.tilt_limit * rng.uniform(0.01, 0.99), rng.uniform(-np.pi, np.pi)
        axis = np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), -np.cos(lean)])
        depth = rng.uniform(0.0, 0.1)
        hub, tool, q = _needle_by_vectors(geometry, axis, depth)
        passive = passive_angles(geometry, q)
        up = -axis
        angles = {
            "panto_a1": q[0],
            "panto_a5": q[1],
            "panto_a2": passive.left_relative,
            "panto_a4": passive.right_relative,
            "panto_a3": -passive.left_absolute,
            "tool_theta_joint": np.arctan2(up[1], up[0]),
            "tool_phi_joint": np.arctan2(np.hypot(up[0], up[1]), up[2]),
            "needle_interaction_joint": np.linalg.norm(hub - tool),
        }
        yield angles, tool, hub, up


@pytest.fixture(scope="module")
def with_meshes(tmp_path_factory):
    """A URDF with its meshes, as the command writes them."""
    out = tmp_path_factory.mktemp("urdf") / "robot.urdf"
    arguments = ["urdf", "export", "--out", str(out), "--origin", "midpoint", "--meshes"]
    done = RUN.invoke(build(), arguments, catch_exceptions=False)
    assert "5 meshes beside it" in done.stdout
    return out


def test_a_thousand_poses_with_meshes_are_those_of_mujoco(with_meshes):
    model = mujoco.MjModel.from_xml_string(
        _for_mujoco(with_meshes.read_text()),
        {file.name: file.read_bytes() for file in with_meshes.parent.glob("*.stl")},
    )
    assert model.nmesh == 5
    assert (model.geom_type == mujoco.mjtGeom.mjGEOM_MESH).sum() == 8
    data, worst = mujoco.MjData(model), 0.0
    for angles, tool, hub, up in _thousand_poses():
        for joint, angle in angles.items():
            data.qpos[model.joint(joint).qposadr[0]] = angle
        mujoco.mj_kinematics(model, data)
        worst = max(
            worst,
            np.abs(data.body("panto_tool0").xpos - tool).max(),
            np.abs(data.body("panto_right_end").xpos - tool).max(),
            np.abs(data.body("needle_interaction_link").xpos - hub).max(),
            np.abs(data.body("needle_interaction_link").xmat.reshape(3, 3)[:, 2] - up).max(),
        )
    assert worst < 1e-9


def test_a_thousand_poses_with_meshes_are_those_of_yourdfpy(with_meshes):
    yourdfpy = pytest.importorskip("yourdfpy", reason="yourdfpy is not installed")
    robot = yourdfpy.URDF.load(str(with_meshes))
    assert len(robot.scene.geometry) == 9  # eight meshes, and the needle's cylinder
    worst = 0.0
    for angles, tool, hub, up in _thousand_poses():
        robot.update_cfg(angles)
        end = robot.get_transform("needle_interaction_link", "world")
        worst = max(
            worst,
            np.abs(robot.get_transform("panto_tool0", "world")[:3, 3] - tool).max(),
            np.abs(robot.get_transform("panto_right_end", "world")[:3, 3] - tool).max(),
            np.abs(end[:3, 3] - hub).max(),
            np.abs(end[:3, 2] - up).max(),
        )
    assert worst < 1e-9


def test_the_meshes_are_closed_and_of_the_profile_s_lengths(with_meshes):
    """VTK reads them: no open edge; bounds, and volumes of a plate with ends of 24 corners."""
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkFeatureEdges, vtkMassProperties
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    for part, length in (
        ("base", PROFILE.geometry.base),
        ("link1", PROFILE.geometry.proximal),
        ("link2", PROFILE.geometry.distal),
        ("motor", None),
        ("hub", None),
    ):
        reader, clean, edges = vtkSTLReader(), vtkCleanPolyData(), vtkFeatureEdges()
        reader.SetFileName(str(with_meshes.with_name(f"robot-{part}.stl")))
        clean.SetInputConnection(reader.GetOutputPort())
        edges.SetInputConnection(clean.GetOutputPort())
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.Update()
        assert edges.GetOutput().GetNumberOfCells() == 0, part
        if length is None:
            continue
        low_x, high_x, low_y, high_y, low_z, high_z = clean.GetOutput().GetBounds()
        width, thick = high_y - low_y, high_z - low_z
        assert high_x - low_x == pytest.approx(length + width, abs=1e-6)
        mass = vtkMassProperties()
        mass.SetInputConnection(clean.GetOutputPort())
        ends = 12.0 * (0.5 * width) ** 2 * np.sin(np.pi / 12.0)
        assert mass.GetVolume() == pytest.approx(thick * (length * width + ends), rel=1e-4)


def test_a_urdf_without_meshes_is_as_it_was_and_lengths_come_back_from_one_with_them(with_meshes):
    assert "<mesh" not in write_urdf(PROFILE)
    assert read_geometry(with_meshes).needle_length == PROFILE.geometry.needle_length


FRAMES = ("panto_tool0", "panto_right_end", "needle_interaction_link")


def _needle_by_vectors(geometry, axis, depth):
    """Hub and tool of a needle through the fulcrum [m], and joint angles, without our poses."""
    fulcrum, length = np.array(geometry.fulcrum), PROFILE.needle_length
    hub = fulcrum - (length - depth) * axis
    tool = fulcrum - fulcrum[2] / axis[2] * axis
    return hub, tool, inverse(geometry, tool[:2])


def _for_mujoco(text: str) -> str:
    """Keep frames that MuJoCo would merge into their parents."""
    extension = '<mujoco><compiler fusestatic="false" discardvisual="false"/></mujoco>'
    return text.replace("</robot>", f"{extension}</robot>")


def test_limits_are_those_of_torque_and_workspace():
    robot = ET.fromstring(write_urdf(PROFILE))
    joints = {joint.get("name"): joint for joint in robot.iter("joint")}
    limit = joints["panto_a1"].find("limit").attrib
    assert float(limit["effort"]) == PROFILE.limits.joint_torque
    assert np.degrees([float(limit["lower"]), float(limit["upper"])]) == pytest.approx(
        [104.0, 200.0], abs=0.2
    )
    assert float(joints["panto_a4"].find("limit").get("effort")) == 0.0
    tilt = float(joints["tool_phi_joint"].find("limit").get("upper"))
    assert tilt == pytest.approx(PROFILE.tilt_limit)
    masses = {
        link.get("name"): float(link.find("inertial/mass").get("value"))
        for link in robot.iter("link")
        if link.find("inertial") is not None
    }
    assert masses["panto_left_link1"] == PROFILE.inertia.proximal_mass
    assert masses["panto_right_link2"] == PROFILE.inertia.distal_mass
    assert masses["tool_phi_link"] == PROFILE.inertia.needle_mass
    rotor = robot.find("link[@name='panto_left_motor']/inertial/inertia").get("izz")
    assert float(rotor) == pytest.approx(PROFILE.inertia.reflected_rotor)


def test_a_tilt_limit_out_of_reach_is_refused():
    workspace = PROFILE.workspace.model_copy(update={"tilt_limit_deg": {"new": 60.0}})
    with pytest.raises(MechanismError, match="does not reach all of its tilt limit of 60°"):
        write_urdf(PROFILE.model_copy(update={"workspace": workspace}))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            description({k: v for k, v in JOINTS.items() if k != "panto_a5"}),
            "'panto_a5' is missing",
        ),
        (
            description(JOINTS | {"panto_a4": "0.11 0 0"}),
            "arms differ: panto_a2 at 0.1 m, panto_a4",
        ),
        (description(JOINTS | {"panto_a2": "${l1} 0 0"}), "is a xacro expression"),
        (description(JOINTS | {"panto_a2": "0.1 0"}), "not three numbers"),
        (description(JOINTS | {"panto_a2": "0.1 nan 0"}), "is not finite"),
        (description(JOINTS | {"panto_a2": "ten 0 0"}), "is not a number"),
        (description(JOINTS | {"panto_a2": "0.1 0.02 0"}), r"goes along \+x"),
        (description(JOINTS | {"panto_a1": "0 0.1 0"}), "must lie on the x axis"),
        (description(JOINTS).replace('rpy="0 0 0"', 'rpy="0 0 1"'), "turned joints"),
        (description(JOINTS, cylinder=""), "cylinder length"),
        (description(JOINTS).replace("cylinder", "box"), "has no cylinder"),
        (description(JOINTS).replace("tool_phi_link", "needle"), "'tool_phi_link' is missing"),
        (description({**JOINTS}) * 2, "is not XML"),
        ("", "is not XML"),
        (description(JOINTS, head='<!DOCTYPE robot SYSTEM "file:///etc/passwd">'), "DOCTYPE"),
        (
            description(
                JOINTS | {"panto_a2": "&long; 0 0"},
                head='<!DOCTYPE robot [<!ENTITY long "0.1">]>',
            ),
            "DOCTYPE",
        ),
    ],
)
def test_a_description_that_is_not_one_is_named(tmp_path, text, message):
    path = written(tmp_path, text)
    with pytest.raises(UrdfError, match=message) as caught:
        read_geometry(path)
    assert str(path) in str(caught.value)


def test_entities_are_refused_in_any_encoding(tmp_path):
    text = description(JOINTS, head='<!DOCTYPE r [<!ENTITY a "0.1">]>').replace(
        '<?xml version="1.0"?>', '<?xml version="1.0" encoding="utf-16"?>'
    )
    path = tmp_path / "wide.urdf"
    path.write_bytes(text.encode("utf-16"))
    with pytest.raises(UrdfError, match="DOCTYPE"):
        read_geometry(path)


def test_lengths_that_make_no_pantograph_are_refused(tmp_path):
    far = JOINTS | {"panto_base_to_fulcrum": "0.0425 0.4 0.09"}
    with pytest.raises(ConfigurationError, match="from the left motor axis"):
        read_geometry(written(tmp_path, description(far)))


def test_a_file_that_is_not_there_or_far_too_large_is_named(tmp_path):
    with pytest.raises(UrdfError, match="cannot read"):
        read_geometry(tmp_path / "none.urdf")
    path = tmp_path / "large.urdf"
    path.write_bytes(b"")
    os.truncate(path, 6_000_000)
    with pytest.raises(UrdfError, match="larger than"):
        read_geometry(path)


def test_a_joint_that_is_there_twice_is_refused(tmp_path):
    text = description(JOINTS)
    again = text[text.index('<joint name="panto_a2"') :].split("</joint>")[0] + "</joint>"
    with pytest.raises(UrdfError, match="'panto_a2' is there twice"):
        read_geometry(written(tmp_path, text.replace("<link ", again + "<link ", 1)))


def test_a_profile_with_lengths_that_do_not_fit_the_rest_is_refused(tmp_path):
    short = read_geometry(written(tmp_path, description(JOINTS, cylinder="0.1")))
    with pytest.raises(ConfigurationError, match="depth_max"):
        profile_like(PROFILE, short, "short")


def test_the_commands_go_there_and_back(tmp_path):
    urdf, profile = tmp_path / "robot.urdf", tmp_path / "mine.yaml"
    arguments = ["urdf", "export", "--profile", "haply-2diy", "--out", str(urdf)]
    done = RUN.invoke(build(), arguments, catch_exceptions=False)
    assert "world at the left motor" in done.stdout
    arguments = ["urdf", "import", str(urdf), "--out", str(profile), "--like", "haply-2diy"]
    done = RUN.invoke(build(), arguments, catch_exceptions=False)
    assert "base 0.038" in done.stdout
    found, model = load_profile(profile), load_profile("haply-2diy")
    assert found.name == "mine"
    assert found.geometry.fulcrum == pytest.approx(model.geometry.fulcrum, abs=1e-15)
    values = {"exclude": {"provenance"}}
    assert found.haply.model_dump(**values) == model.haply.model_dump(**values)
    assert found.geometry.provenance["fulcrum"].value == "imported"
    assert set(found.encoder.provenance.values()) == {"estimated"}  # the model's, not this robot's


def test_commands_refuse_bad_names(tmp_path):
    for arguments, message in (
        (["urdf", "export", "--out", "x", "--origin", "moon"], "left-motor, midpoint"),
        (["urdf", "export", "--out", "x", "--profile", "moon"], "valid names"),
        (["urdf", "import", "x.urdf", "--out", "x.txt"], "is a .yaml file"),
    ):
        with pytest.raises(AcusError, match=message):
            RUN.invoke(build(), arguments, catch_exceptions=False)


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(ExportError, match="cannot write"):
        write_text(tmp_path / "file" / "robot.urdf", "x")


def test_a_machine_that_is_no_pantograph_has_no_urdf():
    with pytest.raises(ConfigurationError, match="is of kind tensegrity"):
        load_pantograph("tensegrity")

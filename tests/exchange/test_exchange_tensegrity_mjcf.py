"""The tensegrity as MJCF: MuJoCo closes its loops at our poses; cables and inertia are ours."""

import mujoco
import numpy as np
import pytest
from typer.testing import CliRunner

from app.commands import build
from app.core.errors import ConfigurationError
from app.exchange.mjcf import write_mjcf
from app.mechanisms.profile import load_profile
from app.mechanisms.tensegrity import CABLE_NAMES, guide_dynamics, inverse, lengths, tensions
from app.mechanisms.tensegrity.geometry import JointReading

RUN = CliRunner()
UPRIGHT = np.array([0.0, 0.0, 1.0])


def profile_of(reading):
    profile = load_profile("tensegrity")
    geometry = profile.geometry.model_copy(update={"reading": JointReading(reading)})
    return profile.model_copy(update={"geometry": geometry})


@pytest.fixture(params=["rhombus", "scissor"])
def machine(request):
    profile = profile_of(request.param)
    model = mujoco.MjModel.from_xml_string(write_mjcf(profile))
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    return profile, model, mujoco.MjData(model)


def elbows(geometry, t):
    """Unit vectors to every joint, by where two cones about known axes meet: nothing of ours."""
    places = {}
    for number, a, s in zip("12", geometry.bases, geometry.sides, strict=True):
        ends = [a, t] if geometry.rhombi == 1 else [a, _unit(a + t), t]
        for names, near, far in zip(("BD", "EF"), ends, ends[1:], strict=False):
            # x·near = x·far = cos s, on either side of their plane
            flat = np.cos(s) / (1.0 + near @ far) * (near + far)
            aside = np.cross(near, far)
            out = np.sqrt(1.0 - flat @ flat) * aside / np.linalg.norm(aside)
            places |= {names[0] + number: flat + out, names[1] + number: flat - out}
        places |= {"A" + number: a, "T" + number: t, "C" + number: _unit(a + t)}
    return places


def _unit(x):
    return x / np.linalg.norm(x)


def pose(profile, model, data, t, depth=0.0):
    """Turn every joint of the model so that its bar points at the next joint of the pose t."""
    geometry = profile.geometry.bars
    at, upright = elbows(geometry, t), elbows(geometry, UPRIGHT)
    values = {"guide_x": np.arctan2(-t[1], t[2]), "guide_y": np.arcsin(t[0])}
    values["needle_depth"] = depth
    if geometry.rhombi == 1:
        for number, a in zip("12", geometry.bases, strict=True):
            values[f"arc{number}"] = _turned(a, UPRIGHT, t)
            grown = 0.5 * (np.arccos(a @ t) - np.arccos(a @ UPRIGHT))
            values[f"arc{number}_near"] = values[f"arc{number}_far"] = grown
    for name, value in values.items():
        data.qpos[model.joint(name).qposadr[0]] = value
    for number in range(model.njnt):  # parents come before their children
        joint = model.joint(number)
        if joint.name in values:
            continue
        mujoco.mj_kinematics(model, data)
        about, towards = joint.name.split("_")
        turn = data.body(joint.bodyid[0]).xmat.reshape(3, 3)
        base = data.body("base").xmat.reshape(3, 3)
        here = base.T @ turn @ upright[towards]  # its own angle is still zero
        data.qpos[joint.qposadr[0]] = _turned(at[about], here, at[towards])
    mujoco.mj_forward(model, data)
    return at


def _turned(axis, start, end):
    return np.arctan2(axis @ np.cross(start, end), start @ end - (axis @ start) * (axis @ end))


def directions(count, seed, limit):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        lean, turn = limit * np.sqrt(rng.uniform()), rng.uniform(-np.pi, np.pi)
        yield np.array([np.sin(lean) * np.cos(turn), np.sin(lean) * np.sin(turn), np.cos(lean)])


@pytest.mark.long("machine")
def test_a_thousand_poses_close_in_mujoco_and_their_cables_are_ours(machine):
    profile, model, data = machine
    geometry = profile.geometry.bars
    worst = 0.0
    for t in directions(1000, 3, profile.tilt_limit):
        data.qpos[:] = 0.0
        at = pose(profile, model, data, t)
        base, origin = data.body("base").xmat.reshape(3, 3), data.body("base").xpos
        for number, radius in zip("12", geometry.radii, strict=True):
            ends = [s for s in range(model.nsite) if model.site(s).name[:2] in (f"T{number}",)]
            assert len(ends) >= 3
            where = [data.site_xpos[s] for s in ends] + [data.site(f"C{number}").xpos]
            meant = [radius * at["T" + number]] * len(ends) + [radius * at["C" + number]]
            gap = np.array(where) - (origin + np.array(meant) @ base.T)
            worst = max(worst, np.abs(gap).max())
        cables = [data.tendon(name).length[0] for name in CABLE_NAMES]
        worst = max(worst, np.abs(cables - lengths(geometry, inverse(geometry, t))).max())
    assert worst < 1e-9


def rates(profile, model, data):
    """Joint rates of the model by those of β, shape (nv, 2): the closed loop's free motions."""
    rows = data.efc_J.reshape(-1, model.nv)[data.efc_type == mujoco.mjtConstraint.mjCNSTR_EQUALITY]
    held = np.zeros((1, model.nv))
    held[0, model.joint("needle_depth").dofadr[0]] = 1.0
    free = np.linalg.svd(np.vstack([rows, held]))[2][-2:].T
    opened = np.zeros((2, model.nv))
    for k, number in enumerate("12"):
        for elbow, sign in (("B", 1.0), ("D", -1.0)):
            opened[k, model.joint(f"A{number}_{elbow}{number}").dofadr[0]] = sign
    return free @ np.linalg.inv(opened @ free)


def test_the_inertia_and_weight_of_the_closed_loops_are_those_that_mujoco_finds(machine):
    profile, model, data = machine
    geometry, depth = profile.geometry.bars, 0.06
    carriages = [k for k in range(model.nbody) if model.body(k).name.startswith("arc")]
    model.body_inertia[carriages] = 1e-9  # what carries C weighs 0.2 % of the machine
    for t in directions(25, 8, 0.9 * profile.tilt_limit):
        data.qpos[:], data.qvel[:] = 0.0, 0.0
        pose(profile, model, data, t, depth)
        model.tendon_armature[:] = 0.0
        mujoco.mj_forward(model, data)
        full = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, full)
        by_joint = rates(profile, model, data)
        centre = profile.needle_length - profile.inertia.needle_centre - depth
        mass = profile.inertia.needle_mass
        second = profile.inertia.needle_inertia + mass * centre**2
        ours = guide_dynamics(
            geometry,
            profile.masses,
            inverse(geometry, t),
            gravity=profile.mounting.gravity,
            needle=(second, mass * centre, 0.0),
        )
        np.testing.assert_allclose(by_joint.T @ full @ by_joint, ours.mass, rtol=1e-5, atol=1e-8)
        weight = by_joint.T @ data.qfrc_bias
        np.testing.assert_allclose(weight, ours.gravity, rtol=1e-5, atol=1e-7)


def _held(profile, t, depth):
    """Tensions of ours that hold guide, bars and needle [N], shape (4,)."""
    geometry, part = profile.geometry.bars, profile.inertia
    beta = inverse(geometry, t)
    moment = part.needle_mass * (profile.needle_length - part.needle_centre - depth)
    weight = guide_dynamics(
        geometry, profile.masses, beta, gravity=profile.mounting.gravity, needle=(0, moment, 0)
    ).gravity
    pulled = tensions(geometry, profile.strings, beta, weight)
    assert not np.any(pulled.shortfall)
    return pulled.tensions


@pytest.mark.long("journey")
def test_tensions_of_ours_balance_guide_and_bars_in_mujoco(machine):
    profile, model, data = machine
    for t in directions(25, 5, 0.8 * profile.tilt_limit):
        data.qpos[:], data.qvel[:], data.ctrl[:] = 0.0, 0.0, 0.0
        pose(profile, model, data, t, 0.06)
        data.ctrl[:] = _held(profile, t, 0.06)
        mujoco.mj_forward(model, data)
        by_joint = rates(profile, model, data)
        weight, rest = by_joint.T @ data.qfrc_bias, by_joint.T @ data.qfrc_actuator
        np.testing.assert_allclose(rest, weight, rtol=1e-4, atol=1e-6)


def test_a_guide_that_is_held_stays_and_one_that_is_let_go_falls(machine):
    """A tenth of a second in MuJoCo's own steps; the loops stay closed to a hundredth of a mm."""
    profile, model, data = machine
    t = next(directions(1, 11, 0.5 * profile.tilt_limit))
    turned = []
    for share in (1.0, 0.0):
        mujoco.mj_resetData(model, data)
        pose(profile, model, data, t, 0.06)
        start = data.site("guide").xpos.copy()
        data.ctrl[:] = share * _held(profile, t, 0.06)
        model.actuator_ctrlrange[:, 0] = 0.0
        for _ in range(200):
            mujoco.mj_step(model, data)
        gaps = [
            np.linalg.norm(data.site(f"T{n}_by_{e}").xpos - data.site(f"T{n}").xpos)
            for n in "12"
            for e in ("BD" if profile.geometry.bars.rhombi == 1 else "EF")
        ]
        turned.append(np.linalg.norm(data.site("guide").xpos - start))
        assert max(gaps) < 1e-5
    assert turned[0] < 0.02 * turned[1]


def test_the_command_writes_it_and_urdf_says_where_it_is(tmp_path):
    file = tmp_path / "holder.xml"
    done = RUN.invoke(
        build(),
        ["urdf", "mjcf", "--profile", "tensegrity", "--out", str(file)],
        catch_exceptions=False,
    )
    assert "4 cables" in done.stdout
    assert mujoco.MjModel.from_xml_path(str(file)).ntendon == 4
    with pytest.raises(ConfigurationError, match="acus urdf mjcf"):
        RUN.invoke(
            build(),
            ["urdf", "export", "--profile", "tensegrity", "--out", str(file)],
            catch_exceptions=False,
        )
    with pytest.raises(ConfigurationError, match="is of kind pantograph"):
        RUN.invoke(
            build(), ["urdf", "mjcf", "--profile", "icube", "--out", "x"], catch_exceptions=False
        )

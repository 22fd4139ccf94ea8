"""The arm as URDF: Pinocchio reads it and finds our flange, our limits and the weight of links."""

from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from app.arm.mechanics import forward, load_arm, published_arm
from app.arm.mechanics.published import write_arm_urdf
from app.commands import build
from app.core.errors import ConfigurationError
from app.core.rotation import rotation_exp
from app.core.transform import RigidTransform

ARM = load_arm()


def read(arm):
    pinocchio = pytest.importorskip("pinocchio", reason="the extra `arm` is not installed")
    model = pinocchio.buildModelFromXML(write_arm_urdf(arm, published_arm()))
    return pinocchio, model, model.createData()


@pytest.mark.parametrize("turn", [(0.0, 0.0, 0.0), (0.3, -1.1, 2.0), (0.0, np.pi / 2, 0.0)])
def test_a_thousand_postures_have_the_flange_and_the_tool_where_ours_are(turn):
    placed = RigidTransform(rotation_exp(turn), np.array([0.1, -0.7, 0.4]))
    held = RigidTransform(rotation_exp([0.2, 0.1, -2.5]), np.array([0.01, 0.02, 0.2]))
    arm = replace(ARM, T_world_base=placed, T_flange_tool=held)
    pinocchio, model, data = read(arm)
    flange, tool = model.getFrameId("flange"), model.getFrameId("tool")
    beyond = RigidTransform.from_translation([0.0, 0.0, arm.flange])
    rng, worst = np.random.default_rng(4), 0.0
    for q in rng.uniform(arm.lower, arm.upper, (1000, 7)):
        pinocchio.framesForwardKinematics(model, data, q)
        at_flange = placed @ forward(arm, q) @ beyond
        for frame, ours in ((flange, at_flange), (tool, at_flange @ held)):
            worst = max(worst, np.abs(data.oMf[frame].homogeneous - ours.matrix()).max())
    assert worst < 1e-9


def test_limits_and_the_weight_of_the_links_are_the_profile_s():
    pinocchio, model, data = read(ARM)
    assert model.upperPositionLimit == pytest.approx(ARM.upper)
    assert model.velocityLimit == pytest.approx(ARM.speed)
    assert model.effortLimit == pytest.approx(ARM.torque)
    published = published_arm()
    for q in np.random.default_rng(2).uniform(ARM.lower, ARM.upper, (50, 7)):
        ours = published.weight_torques(q, (0.0, 0.0, -9.81))
        assert pinocchio.computeGeneralizedGravity(model, data, q) == pytest.approx(ours, abs=1e-9)


def test_the_command_writes_it(tmp_path):
    file = tmp_path / "arm.urdf"
    done = CliRunner().invoke(build(), ["arm", "urdf", "--out", str(file)], catch_exceptions=False)
    assert "iiwa14, 7 joints" in done.stdout
    assert file.read_text(encoding="utf-8") == write_arm_urdf(ARM, published_arm())
    with pytest.raises(ConfigurationError, match="moon"):
        CliRunner().invoke(
            build(), ["arm", "urdf", "--arm", "moon", "--out", str(file)], catch_exceptions=False
        )

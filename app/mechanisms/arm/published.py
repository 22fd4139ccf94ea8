"""The arm as its published description has it: joints by origin and axis, masses of the links.

Numbers of others, kept with source and licence (`resources/arms/published`), that share nothing
with the profile's table: what other programs are built from, to check Acus' kinematics against.
"""

from typing import Annotated

import numpy as np
from pydantic import Field

from app.core import paths
from app.core.arrays import FloatArray
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.transform import RigidTransform

_Number = Annotated[float, Field(ge=-200.0, le=200.0)]
_Triple = tuple[_Number, _Number, _Number]


class PublishedPlace(Strict):
    """Where a frame stands in the link before it.

    Attributes:
        xyz: its origin [m].
        rpy: roll, pitch, yaw about the fixed axes x, y, z [half turns].
    """

    xyz: _Triple
    rpy: _Triple

    @property
    def transform(self) -> RigidTransform:
        """The same as a transform; quarter turns are exact."""
        roll, pitch, yaw = (_turn(k, angle) for k, angle in enumerate(self.rpy))
        return RigidTransform(yaw @ pitch @ roll, np.array(self.xyz))


class PublishedLink(Strict):
    """A link: mass [kg], centre of mass [m], principal moments along its own axes [kg·m²]."""

    mass: _Number
    centre: _Triple
    inertia: _Triple


class PublishedJoint(PublishedPlace, PublishedLink):
    """A joint that turns about its own z, either way as far as `limit_deg`; the link it carries."""

    name: str
    limit_deg: _Number


class PublishedArm(Strict):
    """All of it, from the base outwards."""

    name: str
    joints: tuple[PublishedJoint, ...]
    flange: PublishedPlace
    base: PublishedLink


def published_arm(name: str = "iiwa14") -> PublishedArm:
    """Read a published description that ships.

    Raises:
        ConfigurationError: if there is none of that name, or its file is wrong.
    """
    path = paths.resources() / "arms" / "published" / f"{name}.yaml"
    if not path.is_file():
        raise ConfigurationError(f"no published description of arm {name!r}; there is iiwa14")
    return load(path, PublishedArm)


def _turn(axis: int, half_turns: float) -> FloatArray:
    i, j = (axis + 1) % 3, (axis + 2) % 3
    # sinpi and cospi, so that a quarter turn has exact zeros
    quarters = 2.0 * half_turns
    exact = quarters == round(quarters)
    c, s = (
        ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[int(quarters) % 4]
        if exact
        else (np.cos(np.pi * half_turns), np.sin(np.pi * half_turns))
    )
    turned = np.eye(3)
    turned[i, i], turned[i, j], turned[j, i], turned[j, j] = c, -s, s, c
    return turned

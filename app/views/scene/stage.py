"""What stands in the 3D picture. Built, changed and rendered on one thread only."""

from __future__ import annotations

import os
from itertools import islice, pairwise

import numpy as np
from numpy.typing import NDArray
from vtkmodules import vtkRenderingOpenGL2  # its import registers the OpenGL classes
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from app.core.arrays import FloatArray
from app.core.confidence import principal_axes
from app.core.errors import AcusError
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.reformat import Frame
from app.imaging.structures.structure import Colour
from app.planning.draft import DraftPlan
from app.planning.error_overlay import SMALLEST_MM
from app.planning.needle_overlay import NeedleOverlay
from app.planning.patient import Patient
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.plan.entry_map import COLOURS, SIZES_PX, EntryMap
from app.views.scene.actors import Ball, Cloud, Ring, Rod, SurfaceActor
from app.views.scene.display import ORGAN_COLOURS, SEEN_INTO, Display, Section, rgb
from app.views.scene.guide_actors import GuideActors
from app.views.scene.guides import Guides
from app.views.scene.mesh import Mesh
from app.views.scene.orbit import Orbit
from app.views.scene.robot import Cable, RobotShape
from app.views.scene.sections import (
    GPU_CELLS,
    SOFTWARE_CELLS,
    SectionActor,
    VolumeActor,
)
from app.views.scene.shape import ScenePiece, SceneShape
from app.views.scene.surfaces import Surfaces

EYE_DISTANCE_MM = 2000.0
LINK_RADIUS_MM, FULCRUM_RADIUS_MM = 4.0, 7.0
CABLE_RADIUS_MM, CABLE_PX = 1.3, 2.5
NEEDLE_RADIUS_MM, PATH_RADIUS_MM, POINT_RADIUS_MM, BEAD_RADIUS_MM = 1.2, 0.7, 3.0, 1.1
NEEDLE_PX, PATH_PX, POINT_PX, BEAD_PX, RING_PX = 4.0, 2.0, 9.0, 4.5, 1.6
"""Widths that needle, path and points never fall below on the screen, however small the zoom."""

GHOST = Mark(theme.TEXT)  # white is a ground to the themes, and turns dark on a dark one
GHOST_RADIUS_MM, GHOST_PX = 0.9, 3.0
DASH_MM, DASHES = 5.0, 14
"""The ghost of another needle is dashed, that many times from its tip on."""

BEADS_MM, MOST_BEADS = 10.0, 30
"""Beads on the path stand so far apart: one counts the depth along it."""

SKIN_OPACITY, AROUND_SLICES = 0.4, 0.14
XRAY_OPACITY = {"skin": 0.14, "bone": 0.38, "organ": 0.16}

PEELS, LEFT_OUT = 8, 0.005
"""Layers of translucent surfaces that are put in order, and share of pixels with still more."""

SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software", "swr")
"""Names of drivers that compute pictures without a graphics card."""


class SceneError(AcusError):
    """The 3D view cannot be drawn."""


class Stage:
    """Surfaces, robot, needle and plan in patient LPS millimetres, and the off-screen window.

    Attributes:
        driver: what draws, in the driver's own words; empty before `open`.
        peels: whether translucent surfaces are peeled while the picture stands still.
    """

    def __init__(self) -> None:
        self._renderer = scene = vtkRenderer()
        scene.GetActiveCamera().ParallelProjectionOn()
        scene.SetMaximumNumberOfPeels(PEELS)
        scene.SetOcclusionRatio(LEFT_OUT)
        scene.SetUseOIT(False)  # without peeling the order is that of the actors, kept in `_draw`
        self._window: vtkRenderWindow | None = None
        self._over = over = vtkRenderer()  # over the picture: what must be seen through the body
        over.SetLayer(1)
        over.SetActiveCamera(scene.GetActiveCamera())
        self.driver, self._display = "", Display()
        self._patient: Patient | None = None
        self._bone = SurfaceActor(scene, theme.BONE.colour, 1.0)
        self._organs = {
            name: SurfaceActor(scene, colour, SEEN_INTO.get(name, 1.0))
            for name, colour in ORGAN_COLOURS.items()
        }
        self._structures: list[SurfaceActor] = []
        self._skin = SurfaceActor(scene, theme.SKIN.colour, SKIN_OPACITY)
        self._entries = [
            Cloud(scene, rgb, 0.5 * size) for rgb, size in zip(COLOURS, SIZES_PX, strict=True)
        ]
        self._sections = [SectionActor(scene) for _ in range(3)]
        self._cut_frame: Frame | None = None
        self._cut_section, self._cut_plane = SectionActor(scene), vtkPlane()
        self._volume: VolumeActor | None = None
        self._links: list[Rod] = []
        self._cables: list[Rod] = []
        self._fulcrum = Ball(scene, theme.ROBOT, FULCRUM_RADIUS_MM)
        self._shapes: dict[tuple[object, ...], tuple[list[Rod | Ball], list[Ring]]] = {}
        self._guides: dict[str, GuideActors] = {}
        self._needle = [self._new_piece()]
        self._tip = Ball(scene, theme.NEEDLE_TIP, 2 * NEEDLE_RADIUS_MM, 1.5 * NEEDLE_PX, over)
        self._error = Ball(scene, theme.NEEDLE_TIP, 1.0, opacity=0.35)
        self._ghost: list[Rod] = []
        self._path = Rod(scene, theme.PATH, PATH_RADIUS_MM, PATH_PX, over)
        self._beads: list[Ball] = []
        self._entry = Ball(scene, theme.ENTRY, POINT_RADIUS_MM, POINT_PX, over)
        self._target = Ball(scene, theme.TARGET, POINT_RADIUS_MM, POINT_PX, over)
        self._rings: list[Ring] = []
        self.peels = True
        self._draft = DraftPlan()
        self._tolerances_mm: tuple[float, ...] = ()
        self.set_display(self._display)

    def _new_piece(self) -> Rod:
        return Rod(self._renderer, theme.NEEDLE, NEEDLE_RADIUS_MM, NEEDLE_PX, self._over)

    def open(self) -> None:
        """Make the OpenGL context on the calling thread, and ask what draws."""
        self._window = _off_screen_window()
        self._window.SetNumberOfLayers(2)
        self._window.AddRenderer(self._renderer)
        self._window.AddRenderer(self._over)
        self._window.SetSize(16, 16)
        self._window.Render()
        report = self._window.ReportCapabilities().splitlines()
        found = [line.partition(":")[2] for line in report if "renderer string" in line.lower()]
        self.driver = found[0].strip() if found else "unknown"

    def close(self) -> None:
        """Free the OpenGL context; idempotent."""
        if self._window is not None:
            self._window.RemoveRenderer(self._over)
            self._window.RemoveRenderer(self._renderer)
            self._window.Finalize()
            self._window = None

    @property
    def has_card(self) -> bool:
        """Return whether a graphics card draws, not a program in its place."""
        return not any(name in self.driver.lower() for name in SOFTWARE)

    @property
    def has_volume(self) -> bool:
        """Return whether volumes can be rendered in good time; `ACUS_VOLUME=1` says yes for every
        driver, `ACUS_VOLUME=0` no.
        """
        forced = os.environ.get("ACUS_VOLUME", "")
        return forced == "1" or (self.has_card and forced != "0")

    # --- the patient --------------------------------------------------------------------------
    def set_patient(self, patient: Patient | None) -> None:
        """Take another patient for sections and volume; None lets go of it."""
        self._patient = patient
        if self._volume is not None:
            self._volume.forget()
        self.set_sections(())
        self.set_cut(None)
        self._show_volume()

    def set_surfaces(self, surfaces: Surfaces | None) -> None:
        """Show skin, bone and organs, or none."""
        self._skin.set_meshes((surfaces.skin, surfaces.skin_moving) if surfaces else None)
        self._bone.set_meshes((surfaces.bone, surfaces.bone_moving) if surfaces else None)
        organs = surfaces.organs if surfaces else {}
        for name, actor in self._organs.items():
            actor.set_meshes(organs.get(name))

    def set_structures(self, shown: tuple[tuple[Colour, Mesh], ...]) -> None:
        """Show structures in these colours, and no others."""
        for actor in self._structures:
            actor.remove()
        self._structures = []
        for rgb_255, mesh in shown:
            colour = "#" + "".join(f"{value:02x}" for value in rgb_255)
            actor = SurfaceActor(self._renderer, colour, 1.0)
            actor.set_meshes((mesh,))
            actor.cut(None if self._cut_frame is None else self._cut_plane)
            self._structures.append(actor)
        self.set_display(self._display)

    def set_entry_map(self, shown: EntryMap | None) -> None:
        """Show scored entries as balls in the colours of their classes, or none."""
        for number, cloud in enumerate(self._entries):
            points = None if shown is None else shown.points_mm[shown.classes == number]
            cloud.place(points)

    def set_guides(self, part: str, guides: Guides | None) -> None:
        """Show what a part of the exercise asks for in place of what it showed; None: nothing."""
        before = self._guides.pop(part, None)
        if before is not None:
            before.remove()
        if guides is not None:
            self._guides[part] = guide = GuideActors(self._renderer, self._over, guides)
            guide.show(self._display)
            guide.cut(None if self._cut_frame is None else self._cut_plane)

    # --- how it is shown ----------------------------------------------------------------------
    def set_display(self, display: Display) -> None:
        """Take another background, see into the body otherwise."""
        self._display = display
        self._renderer.SetBackground(*rgb(display.background))
        for solid in self._solids():
            solid.show(display)
        for guide in self._guides.values():
            guide.show(display)
        for actor, part in (
            (self._skin, "skin"),
            (self._bone, "bone"),
            *((actor, "organ") for actor in (*self._organs.values(), *self._structures)),
        ):
            usual = actor.usual_opacity
            actor.set_opacity(min(usual, XRAY_OPACITY[part]) if display.xray else usual)
        if self._cut_frame is not None and not display.xray:  # one looks in through the cut
            self._skin.set_opacity(1.0)
        elif display.slices:
            self._skin.set_opacity(min(self._skin.usual_opacity, AROUND_SLICES))
        self._show_volume()

    def _show_volume(self) -> None:
        rays = bool(self._display.volume) and self.has_volume and self._patient is not None
        if rays and self._volume is None:
            self._volume = VolumeActor(self._renderer)
            self._volume.cut(self._cut_plane if self._cut_frame is not None else None)
        if self._volume is not None:
            cells = GPU_CELLS if self.has_card else SOFTWARE_CELLS
            self._volume.place(self._patient, self._display.volume if rays else "", cells)
        for actor in (self._skin, self._bone):
            actor.set_shown(not rays)
        for actor in self._organs.values():
            actor.set_shown(self._display.organs and not rays)

    def set_sections(self, sections: tuple[Section, ...]) -> None:
        """Show up to three slices as planes, and no others."""
        for number, actor in enumerate(self._sections):
            actor.place(sections[number] if number < len(sections) else None)

    def set_cut(self, section: Section | None) -> None:
        """Take away what lies before a section, and show the CT on it; None shows all."""
        self._cut_frame = None if section is None else section.frame
        self._cut_section.place(section)
        plane = None if section is None else self._cut_plane
        for actor in self._surfaces():
            actor.cut(plane)
        for guide in self._guides.values():
            guide.cut(plane)
        if self._volume is not None:
            self._volume.cut(plane)
        self.set_display(self._display)

    def _solids(self) -> tuple[Rod | Ball | Ring, ...]:
        return (
            *self._links,
            *self._cables,
            self._fulcrum,
            *(solid for solids, rings in self._shapes.values() for solid in (*solids, *rings)),
            *self._needle,
            self._tip,
            self._error,
            *self._ghost,
            self._path,
            *self._beads,
            self._entry,
            self._target,
            *self._rings,
        )

    # --- plan, needle, robot ------------------------------------------------------------------
    def set_plan(self, draft: DraftPlan) -> None:
        """Show entry, target, the path between them with a bead every 10 mm, the tolerances."""
        self._draft = draft
        entry, target = draft.entry_mm, draft.target_mm
        self._entry.put(entry)
        self._target.put(target)
        self._path.span(entry, target)
        beads = np.zeros((0, 3))
        if entry is not None and target is not None:
            start, way = np.asarray(entry), np.subtract(target, entry)
            length = float(np.linalg.norm(way))
            depths = np.arange(BEADS_MM, length - POINT_RADIUS_MM, BEADS_MM)[:MOST_BEADS]
            beads = start + depths[:, None] * (way / max(length, 1e-9))
        while len(self._beads) < len(beads):
            bead = Ball(self._renderer, theme.PATH, BEAD_RADIUS_MM, BEAD_PX, self._over)
            bead.show(self._display)
            self._beads.append(bead)
        for number, bead in enumerate(self._beads):
            bead.put(beads[number] if number < len(beads) else None)
        self._show_rings()

    def set_tolerances(self, radii_mm: tuple[float, ...]) -> None:
        """Show these rings round the target [mm], across the path."""
        self._tolerances_mm = radii_mm
        self._show_rings()

    def _show_rings(self) -> None:
        draft, radii = self._draft, self._tolerances_mm
        while len(self._rings) < len(radii):
            ring = Ring(self._renderer, theme.TARGET, RING_PX, self._over)
            ring.show(self._display)
            self._rings.append(ring)
        axis = np.array([0.0, 1.0, 0.0])
        if draft.entry_mm is not None and draft.target_mm is not None:
            axis = np.subtract(draft.target_mm, draft.entry_mm)
        for number, ring in enumerate(self._rings):
            shown = number < len(radii) and float(np.linalg.norm(axis)) > SMALLEST_MM
            ring.surround(draft.target_mm if shown else None, axis, radii[number] if shown else 0.0)

    def set_needle(self, needle: NeedleOverlay | None, scale: float = 1.0) -> None:
        """Show the needle, grey where its pose is not valid; its error `scale` times enlarged."""
        pieces = [] if needle is None else list(pairwise(needle.points_mm))
        while len(self._needle) < len(pieces):
            self._needle.append(self._new_piece())
            self._needle[-1].show(self._display)
        for number, rod in enumerate(self._needle):
            rod.span(*(pieces[number] if number < len(pieces) else (None, None)))
            rod.set_mark(theme.NEEDLE if needle is None or needle.valid else theme.ROBOT)
        self._tip.put(None if needle is None else needle.tip_mm)
        error = None if needle is None else needle.error
        if error is None:
            self._error.put(None)
        else:
            axes = scale * principal_axes(error.covariance_mm2 + SMALLEST_MM**2 * np.eye(3))
            self._error.put(error.centre_mm, axes)

    def set_ghost(self, ghost: NeedleOverlay | None) -> None:
        """Show another needle beside the own one, dashed; None shows none."""
        dashes = [] if ghost is None else dashed(ghost.points_mm, DASH_MM, DASHES)
        while len(self._ghost) < len(dashes):
            rod = Rod(self._renderer, GHOST, GHOST_RADIUS_MM, GHOST_PX, self._over)
            rod.show(self._display)
            self._ghost.append(rod)
        for number, rod in enumerate(self._ghost):
            rod.span(*(dashes[number] if number < len(dashes) else (None, None)))

    def set_robot(self, robot: RobotShape | None, T_patient_world: RigidTransform) -> None:
        """Show the links and the ball; world metres are brought into the patient."""
        rods = [] if robot is None else robot.links()
        while len(self._links) < len(rods):
            self._links.append(Rod(self._renderer, theme.ROBOT, LINK_RADIUS_MM))
            self._links[-1].show(self._display)
        for number, rod in enumerate(self._links):
            if number < len(rods):
                rod.span(*(T_patient_world @ np.array(rods[number])) / MILLIMETRE)
            else:
                rod.span(None, None)
        pieces = [] if robot is None else _strung(robot.cables(), T_patient_world)
        while len(self._cables) < len(pieces):
            self._cables.append(Rod(self._renderer, theme.ROBOT, CABLE_RADIUS_MM, CABLE_PX))
        for number, rod in enumerate(self._cables):
            ends, mark = pieces[number] if number < len(pieces) else ((None, None), theme.ROBOT)
            rod.show(self._display)
            rod.set_mark(mark)
            rod.span(*ends)
        fulcrum = None if robot is None else (T_patient_world @ robot.fulcrum) / MILLIMETRE
        self._fulcrum.put(fulcrum)

    def set_shape(self, shape: SceneShape | None) -> None:
        """Show what a feature puts into the picture, and nothing else of that sort; None: none."""
        kind = None if shape is None else shape.kind
        for other in self._shapes.keys() - {kind}:
            for solid in (*self._shapes[other][0], *self._shapes[other][1]):
                solid.place(None)
        if shape is None or kind is None:
            return
        if kind not in self._shapes:
            rods = [solid for piece in shape.pieces for solid in self._new_solids(piece)]
            rings = [
                Ring(self._renderer, hoop.mark, RING_PX, self._over)
                for hoop in shape.hoops
                for _ in hoop.radii_mm
            ]
            self._shapes[kind] = rods, rings
            for new in (*rods, *rings):
                new.show(self._display)
        solids, hoops = iter(self._shapes[kind][0]), iter(self._shapes[kind][1])
        for piece in shape.pieces:
            for solid in islice(solids, 3 if piece.round else 1):
                if isinstance(solid, Rod):
                    solid.span(*piece.ends_mm)
                    balls = iter(piece.ends_mm)
                else:
                    solid.put(next(balls))
        for hoop in shape.hoops:
            for radius in hoop.radii_mm:
                next(hoops).surround(hoop.centre_mm, hoop.normal, radius)

    def _new_solids(self, piece: ScenePiece) -> list[Rod | Ball]:
        mark, radius = piece.mark, piece.radius_mm
        balls = [Ball(self._renderer, mark, radius) for _ in piece.ends_mm] if piece.round else []
        return [Rod(self._renderer, mark, radius), *balls]

    # --- the picture --------------------------------------------------------------------------
    def render(self, orbit: Orbit, size_px: tuple[int, int], moving: bool) -> NDArray[np.uint8]:
        """Return the picture, RGBA, shape (height, width, 4), top row first.

        Translucent surfaces are peeled layer by layer while the picture stands still, where the
        driver can; else, and while it moves, their triangles are sorted.

        Raises:
            SceneError: if the stage is closed.
        """
        window = self._window
        if window is None:
            raise SceneError("the 3D view is closed: open it before rendering")
        self._aim(orbit, size_px)
        width, height = size_px
        window.SetSize(width, height)
        self._draw(window, moving, self.peels and not moving)
        peeled = self._renderer.GetLastRenderingUsedDepthPeeling()
        if self.peels and not moving and not peeled and self._skin.is_seen_through:
            self.peels = False  # not with this driver
            self._draw(window, moving, peels=False)
        pixels = vtkUnsignedCharArray()
        window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, pixels, 0)
        picture = vtk_to_numpy(pixels).reshape(height, width, 4)[::-1].copy()
        picture[:, :, 3] = 255
        return picture

    def _draw(self, window: vtkRenderWindow, moving: bool, peels: bool) -> None:
        self._renderer.SetUseDepthPeeling(peels)
        for actor in self._surfaces():
            actor.choose(moving, ordered=peels)
        if not peels:  # only what faces the eye is drawn: what comes nearest lies over the others
            backwards = np.array(self._renderer.GetActiveCamera().GetViewPlaneNormal())
            through = [actor for actor in self._surfaces() if actor.is_seen_through]
            for actor in sorted(through, key=lambda actor: actor.nearest(backwards)):
                actor.draw_last()
        window.Render()

    def _surfaces(self) -> tuple[SurfaceActor, ...]:
        covered = (guide.covered for guide in self._guides.values() if guide.covered is not None)
        return self._skin, self._bone, *self._organs.values(), *self._structures, *covered

    def _aim(self, orbit: Orbit, size_px: tuple[int, int]) -> None:
        camera = self._renderer.GetActiveCamera()
        camera.SetFocalPoint(*orbit.focus_mm)
        camera.SetPosition(*(orbit.focus_mm + EYE_DISTANCE_MM * orbit.backwards))
        camera.SetViewUp(*orbit.up)
        camera.SetParallelScale(0.5 * size_px[1] * orbit.mm_per_px(size_px))
        camera.SetClippingRange(1.0, 2.0 * EYE_DISTANCE_MM)
        mm_per_px = orbit.mm_per_px(size_px)
        for solid in self._solids():
            solid.zoom(mm_per_px)
        for guide in self._guides.values():
            guide.zoom(mm_per_px)
        frame = self._cut_frame
        if frame is not None:
            side = 1.0 if float(frame.normal @ orbit.backwards) >= 0.0 else -1.0
            self._cut_plane.SetOrigin(*frame.origin_mm)
            self._cut_plane.SetNormal(*(-side * frame.normal))
            self._cut_section.step_back(side * frame.normal)


def _strung(
    cables: list[Cable], T_patient_world: RigidTransform
) -> list[tuple[tuple[FloatArray, FloatArray], Mark]]:
    """Return the straight pieces of cables with their colours: one of a taut one, else dashes."""
    pieces: list[tuple[tuple[FloatArray, FloatArray], Mark]] = []
    for cable in cables:
        ends = (T_patient_world @ np.array(cable.ends)) / MILLIMETRE
        parts = dashed(ends, DASH_MM, DASHES) if cable.slack else [(ends[0], ends[1])]
        pieces += [(part, cable.mark) for part in parts]
    return pieces


def dashed(points_mm: FloatArray, dash_mm: float, most: int) -> list[tuple[FloatArray, FloatArray]]:
    """Return the ends of dashes along a line of corners, from its last point on.

    Args:
        points_mm: corners, shape (n, 3).
        dash_mm: length of a dash, and of the gap after it [mm].
        most: dashes at most.
    """
    corners = points_mm[::-1]
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(corners, axis=0), axis=1))))
    starts = np.arange(0.0, min(float(along[-1]), 2.0 * dash_mm * most), 2.0 * dash_mm)[:most]
    places = [
        np.column_stack([np.interp(at, along, corners[:, k]) for k in range(3)])
        for at in (starts, np.minimum(starts + dash_mm, along[-1]))
    ]
    return list(zip(*places, strict=True))


def _off_screen_window() -> vtkRenderWindow:
    """EGL needs no display and works the same with and without one; else what VTK offers."""
    kind = getattr(vtkRenderingOpenGL2, "vtkEGLRenderWindow", vtkRenderWindow)
    window: vtkRenderWindow = kind()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetAlphaBitPlanes(1)
    return window

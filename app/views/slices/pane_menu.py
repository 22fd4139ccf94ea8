"""The context menu of a pane: windows, slab, turn, cine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QInputDialog, QMenu

from app.views.kit.text import tr
from app.views.slices.cine import RATES
from app.views.slices.looks import KINDS, Slab, kind_name
from app.views.slices.presets import menu_windows

if TYPE_CHECKING:
    from app.views.slices.pane import SlicePane

THICKNESSES_MM = (0.0, 3.0, 5.0, 10.0, 20.0, 40.0)


def fill_windows(menu: QMenu, pane: SlicePane) -> None:
    """Add every window with its key; they cannot be chosen while they are locked."""
    greys = pane.viewing.greys
    for name, key, window in menu_windows(pane.viewing.volume, greys.kept):
        action = menu.addAction(f"{name}  {window.width:g} / {window.level:g}\t{key}")
        action.setEnabled(not greys.is_locked)
        action.triggered.connect(lambda _=False, w=window: pane.viewing.set_window(w, pane.pane))


def build_menu(pane: SlicePane) -> QMenu:
    """Return the menu of a pane as things are now."""
    menu, greys = QMenu(pane), pane.viewing.greys
    fill_windows(menu, pane)
    _entry(menu, tr("Keep this window…"), lambda: _ask_name(pane))
    if greys.kept:
        forget = menu.addMenu(tr("Forget a kept window"))
        for name in greys.kept:
            _entry(forget, name, partial(greys.forget, name))
    menu.addSeparator()
    _switch(menu, tr("Invert grey") + "\tI", greys.is_inverted, pane.actions_of.invert)
    _switch(menu, tr("One window for all panes"), greys.is_linked,
            lambda: greys.set_linked(not greys.is_linked))  # fmt: skip
    lock = _switch(menu, tr("Lock window and level"), greys.is_locked,
                   lambda: greys.set_locked(not greys.is_locked))  # fmt: skip
    lock.setEnabled(not greys.is_fixed)
    menu.addSeparator()
    slabs = menu.addMenu(tr("Slab"))
    _slabs(slabs, pane)
    slabs.setEnabled(not pane.viewing.is_slab_fixed)
    _turns(menu.addMenu(tr("Turn and mirror")), pane)
    cine = menu.addMenu(tr("Cine"))
    _switch(cine, tr("Run through the slices") + "\tC", pane.cine.is_running, pane.cine.toggle)
    cine.addSeparator()
    for rate in RATES:
        _switch(cine, tr("{rate} slices a second", rate=rate), rate == pane.cine.rate,
                partial(pane.cine.set_rate, rate))  # fmt: skip
    menu.addSeparator()
    _entry(menu, tr("Fit to pane") + "\t=", pane.canvas.fit)
    _entry(menu, tr("Reset view") + "\t" + tr("Space"), pane.reset)
    _entry(menu, tr("Maximise or restore") + "\tX", pane.maximise_wanted.emit)
    return menu


def _entry(menu: QMenu, text: str, command: Callable[[], object]) -> None:
    menu.addAction(text).triggered.connect(lambda _=False: command())


def _switch(menu: QMenu, text: str, on: bool, command: Callable[[], object]) -> QAction:
    action = menu.addAction(text)
    action.setCheckable(True)
    action.setChecked(on)
    action.triggered.connect(lambda _=False: command())
    return action


def _slabs(menu: QMenu, pane: SlicePane) -> None:
    slab, take = pane.viewing.look(pane.pane).slab, pane.actions_of.take_slab
    for kind in KINDS:
        wanted = Slab(kind, slab.thickness_mm or 10.0)
        _switch(menu, kind_name(kind), slab == wanted, partial(take, wanted))
    menu.addSeparator()
    for thickness in THICKNESSES_MM:
        text = tr("{thickness:g} mm", thickness=thickness) if thickness else tr("One slice")
        wanted = replace(slab, thickness_mm=thickness)
        _switch(menu, text, slab == wanted, partial(take, wanted))


def _turns(menu: QMenu, pane: SlicePane) -> None:
    actions = pane.actions_of
    _entry(menu, tr("Right by 90°"), lambda: actions.turn(1))
    _entry(menu, tr("Left by 90°"), lambda: actions.turn(-1))
    _entry(menu, tr("By 180°: from the other side of the table"), lambda: actions.turn(2))
    _entry(menu, tr("Mirror left-right"), lambda: actions.mirror(False))
    _entry(menu, tr("Mirror top-bottom"), lambda: actions.mirror(True))
    menu.addSeparator()
    _entry(menu, tr("As radiologists read it"), actions.upright)


def _ask_name(pane: SlicePane) -> None:
    """Ask for the name of the present window; the window goes on meanwhile."""
    window = pane.viewing.greys.of(pane.pane)
    dialog = QInputDialog(pane)
    dialog.setWindowTitle(tr("Keep this window"))
    dialog.setLabelText(
        tr("Name for W {width:.0f}  L {level:.0f}", width=window.width, level=window.level)
    )
    dialog.textValueSelected.connect(
        lambda name: pane.viewing.greys.keep(name.strip()[:40], window) if name.strip() else None
    )
    dialog.finished.connect(dialog.deleteLater)
    dialog.open()

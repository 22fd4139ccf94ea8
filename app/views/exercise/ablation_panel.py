"""Electrodes and generator beside the needle: what comes next, and what was ablated."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import QComboBox, QWidget

from app.imaging.field.tissue_words import tissue_words
from app.session.ablation import AblationState
from app.session.ablation_shown import AblationShown, MarginsShown
from app.session.procedure import ProcedureState, Step, ToolInHand
from app.views.exercise.step_panel import (
    StepPanel,
    first_of,
    other_step,
    shared_results,
    shared_words,
)
from app.views.kit import theme
from app.views.kit.text import literal, number, tr, translated


class AblationPanel(StepPanel):
    """Offers the step that follows; hidden where the exercise ablates nothing."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: tuple[object, ...] = ()
        self.setting = QComboBox(self)
        self.setting.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setting.setAccessibleName(tr("Power and time of the generator"))
        for widget in (self.held, self.next, self.other, self.setting, self.results):
            self._column.addWidget(widget)
        self._enable(None)
        self.hide()

    def show_ablation(
        self, state: ProcedureState | None, commands: bool, inside: bool | None = False
    ) -> None:
        """Show how an attempt stands with its electrodes, or nothing.

        Args:
            state: how it stands; None without electrodes.
            commands: whether steps can be done now.
            inside: whether the tip is in the body; None where nobody is told.
        """
        self.setVisible(state is not None)
        now = state, commands, inside
        if state is None or state.ablation is None:
            self._state, self._shown = None, ()
            self._enable(None)
        elif now != self._shown:
            if self._state is None or self._state.part is not state.part:
                self._offer(state.ablation)
            self._state, self._shown = state, now
            self._show(state, state.ablation, commands, inside)

    def _offer(self, ablation: AblationState) -> None:
        """Offer what the generator's table has, the planned row at first."""
        self.setting.setStyleSheet(f"font-size: {theme.SMALL_PX}px;")  # whole in a narrow rail
        with QSignalBlocker(self.setting):
            self.setting.clear()
            for row in ablation.table.rows:
                words = tr(
                    "{power} W, {minutes} min: {long}×{short} mm",
                    power=number(row.power_w, "g"),
                    minutes=number(row.minutes, "g"),
                    long=number(row.long_mm, "g"),
                    short=number(row.short_mm, "g"),
                )
                self.setting.addItem(words)
            self.setting.setCurrentIndex(ablation.planned_row)
        self.setting.setToolTip(
            literal(f"{translated(ablation.table.words)}\n{ablation.table.source}")
        )

    def _show(
        self, state: ProcedureState, ablation: AblationState, commands: bool, inside: bool | None
    ) -> None:
        if state.tool is ToolInHand.ANAESTHETIC:
            self.held.setText(tr("Held: {tool}", tool=translated(state.words)))
        else:
            self.held.setText(_standing(ablation))
        possible = state.possible if commands else ()
        # Where nobody is told, the key does what is usual: one deposit, then the electrode.
        injects = not state.deposits if inside is None else inside
        wanted = (
            first_of(state, possible),
            Step.INJECT if injects else Step.TAKE_NEEDLE,
            None if inside is False else Step.PLACE_ELECTRODE,
            Step.ABLATE,
            None if inside is True else Step.ROLL_OVER,
        )
        self._step = next((step for step in wanted if step in possible), None)
        self.next.setText(_words(self._step, ablation))
        self._enable(self._step, other_step(state, possible, inside))
        self.setting.setEnabled(ablation.reached is None)
        lines = shared_results(state) + results(AblationShown.of_state(ablation))
        self.results.setText("\n".join(lines))

    def _enable(self, step: Step | None, beside: Step | None = None) -> None:
        self.next.setEnabled(step is not None)
        self._offer_other(beside)
        self._follow_buttons()

    def _setting(self) -> tuple[int, float]:
        return max(0, self.setting.currentIndex()), 0.0


def of_electrodes(
    state: ProcedureState | None,
) -> tuple[ProcedureState | None, ProcedureState | None]:
    """Return a procedure for this panel or for that of the other steps; None for the other one."""
    if state is None or state.ablation is None:
        return None, state
    return state, None


def _standing(ablation: AblationState) -> str:
    of = len(ablation.plans)
    if ablation.reached is not None:
        return tr("Ablated")
    if ablation.all_placed:
        return tr("All {n} electrodes are in place", n=of)
    return tr("Electrode {n} of {of}", n=ablation.number, of=of)


def _words(step: Step | None, ablation: AblationState) -> str:
    if words := shared_words(step):
        return words
    if step is Step.TAKE_NEEDLE:
        return tr("Take the electrode (J)")
    if step is Step.PLACE_ELECTRODE:
        return tr("Leave electrode {n} here (J)", n=ablation.number)
    if step is Step.ABLATE:
        return tr("Start the generator (J)")
    return tr("Next step (J)")


def results(shown: AblationShown) -> list[str]:
    """Say what is planned and what was reached, a line each."""
    lines = [_margin_line(tr("Planned"), shown.planned, shown.wanted_mm)]
    lines += [
        tr("Electrode {n}: {mm:.1f} mm from its place", n=n, mm=off)
        for n, off in enumerate(shown.off_mm, start=1)
    ]
    if shown.reached is not None:
        lines.append(_margin_line(tr("Reached"), shown.reached, shown.wanted_mm))
    lines += warnings(shown.newest)
    if shown.ex_vivo:
        lines.append(tr("▲ Zones ex vivo: without blood, larger than in a patient"))
    return lines


def warnings(margins: MarginsShown) -> list[str]:
    """Say which vessels lie near a zone, and what else it reaches."""
    lines = [
        tr(
            "▲ {vessel} {mm:.1f} mm from the zone: it may be cooled there, which is not reckoned",
            vessel=translated(tissue_words(name)),
            mm=distance,
        )
        for name, distance in margins.vessels
    ]
    return lines + [
        tr(
            "✖ the zone reaches {tissue}: {ml:.1f} ml of it",
            tissue=translated(tissue_words(name)),
            ml=volume / 1e3,
        )
        for name, volume in margins.reached
    ]


def _margin_line(title: str, margins: MarginsShown, wanted_mm: float) -> str:
    mark = "✔" if margins.least_mm >= wanted_mm else "▲" if margins.least_mm >= 0.0 else "✖"
    return tr(
        "{mark} {title}: least margin {mm:.1f} mm of {wanted:g}, lesion {share:.1f} %",
        mark=mark,
        title=title,
        mm=margins.least_mm,
        wanted=wanted_mm,
        share=100.0 * margins.share,
    )

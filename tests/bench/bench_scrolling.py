"""Scrolling one view at 1400×900: image, other views' crosshairs and repaint; W/L drag likewise.

Figure to reach: 16 ms median and p99. Peers in the same run, on the same slices and pane sizes:
pyqtgraph's own ImageItem.setImage with levels and InfiniteLines for crosshairs; matplotlib's
set_data, the kind of viewer the thesis built on. Painting is Qt's raster engine in both.
"""

import os
import time
from collections.abc import Callable

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import numpy as np
import pyqtgraph
from PySide6.QtCore import QEventLoop
from PySide6.QtWidgets import QApplication, QWidget

from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.series import Series
from app.imaging.volume import Volume
from app.imaging.window import WindowLevel
from app.views.kit.theme import apply_theme
from app.views.reading.layouts import SCENE, ViewGrid
from app.views.slices.pane import SlicePane
from app.views.slices.panes import MPR_PANES
from app.views.slices.presets import default_window
from app.views.slices.viewing import Viewing

SIZE, SHAPE, STEPS, GOAL_MS = (1400, 900), (300, 512, 512), 150, 16.0


def synthetic() -> Volume:
    """A 512² × 300 volume with structure and noise."""
    rng = np.random.default_rng(1)
    k, j, i = SHAPE
    plane = np.hypot(*np.meshgrid(np.linspace(-1, 1, j), np.linspace(-1, 1, i), indexing="ij"))
    base = np.where(plane < 0.8, 40, -1000).astype(np.int16)
    hu = np.stack([base + rng.integers(-60, 60, (j, i), dtype=np.int16) for _ in range(k)])
    affine = np.diag([0.78, 0.78, 1.0, 1.0])
    series = Series(
        "1", "CT", "bench", (i, j, k), None, None, None, True, "", (), "CT-BENCH", "1", ()
    )
    return Volume(hu, affine, series)


def measure(
    application: QApplication, step: Callable[[int], None], drawn: Callable[[], bool] = lambda: True
) -> np.ndarray:
    """Milliseconds of `STEPS` steps, each until everything is painted."""
    times = []
    for number in range(STEPS + 10):
        start = time.perf_counter()
        step(number)
        application.processEvents()
        while not drawn():
            application.processEvents(QEventLoop.ProcessEventsFlag.WaitForMoreEvents)
        application.processEvents()
        times.append(1e3 * (time.perf_counter() - start))
    return np.array(times[10:])


def ours(application: QApplication, volume: Volume) -> dict[str, np.ndarray]:
    """Scroll each view, then drag the window, in the program's own panes."""
    viewing = Viewing(default_window())
    panes = [SlicePane(viewing, pane) for pane in MPR_PANES]
    grid = ViewGrid({str(pane.pane): pane for pane in panes} | {SCENE: QWidget()})
    grid.resize(*SIZE)
    grid.show()
    viewing.set_volume(volume)
    application.processEvents()

    def drawn() -> bool:
        return all(pane.canvas.is_drawn for pane in panes)

    found = {
        f"scroll {pane}": measure(
            application, lambda n, v=pane: viewing.show_slice(v, 50 + n), drawn
        )
        for pane in MPR_PANES
    }
    found["window/level"] = measure(
        application, lambda n: viewing.set_window(WindowLevel(300.0 + 2 * n, 40.0 + n)), drawn
    )
    viewing.pictures.close()
    grid.close()
    grid.deleteLater()
    application.processEvents()
    return found


def plain_pyqtgraph(application: QApplication, volume: Volume) -> np.ndarray:
    """Scroll the axial one of three plain image views with crosshairs."""
    slicer = OrthogonalSlicer(volume)
    widget = pyqtgraph.GraphicsLayoutWidget()
    widget.resize(*SIZE)
    images, lines = {}, []
    for number, view in enumerate(View):
        box = widget.addViewBox(*divmod(number, 2), lockAspect=True, invertY=True)
        images[view] = pyqtgraph.ImageItem(axisOrder="row-major")
        images[view].setImage(slicer.image(view, 100), levels=(-160, 240))
        box.addItem(images[view])
        if view is not View.AXIAL:
            lines.append(pyqtgraph.InfiniteLine(100, angle=0, pen="r"))
            box.addItem(lines[-1])
    widget.show()
    application.processEvents()

    def step(number: int) -> None:
        images[View.AXIAL].setImage(slicer.image(View.AXIAL, 50 + number), levels=(-160, 240))
        for line in lines:
            line.setValue(50 + number)

    times = measure(application, step)
    widget.close()
    return times


def plain_matplotlib(volume: Volume) -> np.ndarray:
    """Scroll one of three matplotlib images, drawn with its Agg renderer."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot

    slicer = OrthogonalSlicer(volume)
    figure, axes = pyplot.subplots(2, 2, figsize=(14, 9), dpi=100)
    shown = {
        view: axis.imshow(slicer.image(view, 100), cmap="gray", vmin=-160, vmax=240)
        for view, axis in zip(View, axes.flat[:3], strict=True)
    }
    lines = [axis.axhline(100, color="r") for axis in axes.flat[1:3]]
    figure.canvas.draw()
    times = []
    for number in range(12):
        start = time.perf_counter()
        shown[View.AXIAL].set_data(slicer.image(View.AXIAL, 50 + number))
        for line in lines:
            line.set_ydata([50 + number, 50 + number])
        figure.canvas.draw()
        times.append(1e3 * (time.perf_counter() - start))
    pyplot.close(figure)
    return np.array(times[2:])


def report(name: str, times: np.ndarray, reference: np.ndarray | None = None) -> None:
    """Print one line."""
    line = f"{name:<28} median {np.median(times):7.2f} ms   p99 {np.percentile(times, 99):7.2f} ms"
    if reference is not None:
        line += f"   {np.median(times) / np.median(reference):5.1f} × axial scroll"
    print(line)


def main() -> None:
    """Print medians, p99 and ratios."""
    application = QApplication.instance() or QApplication([])
    apply_theme(application)
    volume = synthetic()
    print(f"{SIZE[0]}×{SIZE[1]}, volume {SHAPE[2]}×{SHAPE[1]}×{SHAPE[0]}, figure: ≤ {GOAL_MS:g} ms")
    found = ours(application, volume)
    for name, times in found.items():
        report(f"Acus {name}", times)
    axial = found["scroll axial"]
    report("pyqtgraph scroll axial", plain_pyqtgraph(application, volume), axial)
    report("matplotlib scroll axial", plain_matplotlib(volume), axial)


if __name__ == "__main__":
    main()

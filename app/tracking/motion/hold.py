"""No filter: the newest depth, and no idea of where the tip is going."""

from app.tracking.motion.depth_filter import HAND_SPEED, DepthFilter


class Hold(DepthFilter):
    """The newest depth as it came."""

    def __init__(self) -> None:
        super().__init__()
        self._depth = self._variance = 0.0

    @property
    def lag(self) -> float:
        """None at the newest fix; all of a fix's age later."""
        return 0.0

    def _begin(self, depth: float, variance: float) -> None:
        self._depth, self._variance = depth, variance

    def _step(self, dt: float, depth: float, variance: float) -> None:
        self._begin(depth, variance)

    def _ahead(self, dt: float) -> tuple[float, float, float]:
        return self._depth, 0.0, self._variance + (HAND_SPEED * dt) ** 2

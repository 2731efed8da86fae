"""How far along its slider a rate is: from soft to stiff, equal steps are equal factors."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

STEP = 0.01
"""What one step adds to a rate, relative to it."""

DIGITS = 4
"""Of the rates that a slider gives: finer than its steps, and short enough to read."""

WIDEST = 1e3
"""How many times its softest rate a slider's stiffest is, where the softest bound is zero."""


@dataclass(frozen=True)
class Travel:
    """The way of a slider, which counts in whole steps from the softest rate."""

    softest: float
    """N/m, above zero."""
    stiffest: float

    @property
    def length(self) -> int:
        """The number of steps from the softest rate to the stiffest."""
        return math.ceil(math.log(self.stiffest / self.softest) / math.log1p(STEP))

    def position(self, rate: float) -> int:
        """The step that is nearest to a rate, N/m; of one beyond the slider, that end of it."""
        if rate <= self.softest:
            return 0
        way = math.log(rate / self.softest) / math.log(self.stiffest / self.softest)
        return min(round(self.length * way), self.length)

    def rate(self, position: float, marked: float) -> float:
        """The rate at a step, N/m: the marked one where that is the nearest step."""
        if self.has(marked) and position == self.position(marked):
            return marked
        rate = self.softest * (self.stiffest / self.softest) ** (position / self.length)
        return float(f"{rate:.{DIGITS}g}")

    def has(self, rate: float) -> bool:
        """Whether a rate is neither softer nor stiffer than the slider's ends."""
        return self.softest <= rate <= self.stiffest


def travel(softest: float, stiffest: float, known: Sequence[float]) -> Travel:
    """The way from one bound to the other, wide enough for known rates, N/m; zero is not on it."""
    stiffest = max(stiffest, *known)
    positive = [rate for rate in known if rate > 0]
    return Travel(min(softest or stiffest / WIDEST, *positive, stiffest), stiffest)

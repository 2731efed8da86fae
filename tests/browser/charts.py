"""The curves of the page's charts, whose lines lie where any of them has some."""

import numpy as np

from modeviz.viewer.panels.plots import SHOWN_HZ

SINGLE_HZ = 1e-5
"""How far a line of the band is rounded in single precision."""


def at_lines(drawn_hz, drawn, frequency_hz, expected):
    """What is drawn at those lines that a chart shows, and what should be.

    Args:
        drawn_hz: (n_drawn,), the lines of a chart.
        drawn: (n_drawn,), a curve there.
        frequency_hz: (n_lines,), its own lines.
        expected: (n_lines,).
    """
    f = shown(frequency_hz)
    inside = np.isin(frequency_hz, f)
    return np.asarray(drawn)[nearest(drawn_hz, f)], np.asarray(expected)[inside]


def has_lines(drawn_hz, frequency_hz):
    """Whether a chart has those of some lines that it shows."""
    f = shown(frequency_hz)
    return bool(np.abs(np.asarray(drawn_hz)[nearest(drawn_hz, f)] - f).max() < SINGLE_HZ)


def shown(frequency_hz):
    f = np.asarray(frequency_hz)
    return f[(f >= SHOWN_HZ[0]) & (f <= SHOWN_HZ[1])]


def nearest(drawn_hz, frequency_hz):
    return np.abs(np.subtract.outer(frequency_hz, drawn_hz)).argmin(axis=1)

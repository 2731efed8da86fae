"""What a page shows, as its server has told it, without a browser."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.page_client import Message, buffers, messages
from modeviz.analysis.results import Results
from modeviz.vehicle.arrays import Array, Floats

FIELDS = {"Vertical": "vertical", "Lateral": "lateral", "Fore-aft": "fore_aft"}
"""The rates of a mount group, as sliders are labelled."""

UNIT, PER_UNIT = "N/mm", 1e3
"""Of the numbers beside them, N/m."""

AGREE_DB = 2.0**-18
"""Spectra reach the page in single precision: how far 128 dB are rounded."""


LEAST_COMMON = 0.5
"""Of the lines of a spectrum that have to be compared with another."""

SHARP = 1e-3
"""How near a resonance is, and how little it is damped, together, where rounding shows."""


@dataclass(frozen=True)
class Row:
    """The slider of a mount rate and the number beside it."""

    group: str
    field: str
    slider: Message
    box: Message

    @property
    def rate(self) -> float:
        """That which is shown, N/m."""
        return PER_UNIT * self.box["value"]

    @property
    def length(self) -> int:
        """Steps from one end of the slider to the other."""
        return self.slider["props"]["max"]


class Screen:
    """The widgets of a page, with the values and the data that they have now."""

    def __init__(self) -> None:
        """Shows nothing yet."""
        self._widgets: dict[str, Message] = {}

    def hear(self, frame: bytes | str) -> bool:
        """Takes in what the server says; whether a spectrum has other data than before."""
        arrays, is_new = None, False
        for message in messages(frame):
            known = self._widgets.get(message.get("uuid", ""))
            if message["type"].startswith("Gui") and "props" in message:
                self._widgets[message["uuid"]] = known = message
            elif message["type"] == "GuiUpdateMessage" and known is not None:
                for name, value in message["updates"].items():
                    (known if name == "value" else known["props"])[name] = value
            elif message["type"] == "GuiRemoveMessage":
                self._widgets.pop(message["uuid"], None)
            if known is not None and _is_spectrum(known) and _has_data(message):
                arrays = buffers(frame) if arrays is None else arrays
                data = [_array(each, arrays) for each in known["props"]["data"]]
                before, known["arrays"] = known.get("arrays"), data
                is_new |= before is None or not np.array_equal(before[-2], data[-2])
        return is_new

    def rows(self) -> Sequence[Row]:
        """The sliders of mount rates, in the order of the page."""
        every = self._widgets.values()
        numbers = {
            (each["container_uuid"], each["props"]["order"]): each
            for each in every
            if each["type"] == "GuiNumberMessage" and each["props"]["label"] == UNIT
        }
        rows = []
        for slider in [each for each in every if each["type"] == "GuiSliderMessage"]:
            folder, label = slider["container_uuid"], slider["props"]["label"].split("  ")[0]
            box = numbers.get((folder, slider["props"]["order"] + 1))
            if box and label in FIELDS:
                group = self._widgets[folder]["props"]["label"].split("  ")[0]
                rows.append(Row(group, FIELDS[label], slider, box))
        return sorted(rows, key=lambda row: row.slider["props"]["order"])

    def spectra(self) -> Sequence[Sequence[Array]]:
        """The data of each spectrum: frequencies, then its curves, the present one last but one."""
        return [each["arrays"] for each in self._widgets.values() if "arrays" in each]


def is_drawn(frequency_hz: Floats, curve: Floats, spectrum: Sequence[Any]) -> bool:
    """Whether a spectrum, whose last two series are the present one and its peaks, shows a curve."""
    expected, now = np.interp(spectrum[0], frequency_hz, curve), np.array(spectrum[-2], float)
    return len(now) == len(expected) and np.allclose(now, expected, rtol=0, atol=AGREE_DB)


def off_by(
    frequency_hz: Floats, curve: Floats, spectrum: Sequence[Any], is_sharp: NDArray[np.bool_]
) -> tuple[float, float]:
    """By how many dB at most a spectrum misses a curve, and at which frequency, Hz.

    Only lines count that both have: each has its own on resonances.

    Args:
        frequency_hz: (n_freqs,), rising.
        curve: (n_freqs,), dB.
        spectrum: as of `is_drawn`.
        is_sharp: (n_freqs,), whether a line is one of `sharp_lines`, where they may differ.
    """
    drawn, now = np.asarray(spectrum[0]), np.asarray(spectrum[-2], float)
    after = np.searchsorted(frequency_hz, drawn).clip(1, len(frequency_hz) - 1)
    nearest = after - (drawn - frequency_hz[after - 1] < frequency_hz[after] - drawn)
    common = np.isclose(drawn, frequency_hz[nearest], rtol=1e-9, atol=0)
    compared = common & ~is_sharp[nearest]
    if compared.mean() < LEAST_COMMON:
        return np.inf, 0.0
    differences = np.where(compared, np.abs(now - curve[nearest]), 0.0)
    worst = int(differences.argmax())
    return float(differences[worst]), float(drawn[worst])


def sharp_lines(results: Results) -> NDArray[np.bool_]:
    """Which lines are on a resonance that magnifies the rounding of a solve, (n_freqs,).

    Two solves of the same rates differ by some 1e-10, which a mode of frequency f_k and damping ratio
    ζ_k magnifies by 1/(2 (|f/f_k - 1| + ζ_k)).
    """
    modes = results.modes
    moving = modes.frequency_hz > 0
    f, zeta = modes.frequency_hz[moving], modes.damping_ratio[moving]
    away = np.abs(results.frequency_hz[:, None] / f - 1) + zeta
    return away.min(axis=1) < SHARP


def _is_spectrum(widget: Message) -> bool:
    is_plot = widget["type"] == "GuiUplotMessage"
    return is_plot and widget["props"]["series"][0]["label"] == "Hz"


def _has_data(message: Message) -> bool:
    return "data" in message.get("props", message.get("updates", ()))


def _array(placeholder: Message, arrays: Sequence[bytes]) -> Array:
    return np.frombuffer(arrays[placeholder["__binary_index"]], placeholder["dtype"])

"""Road spectra as a table, one line for each frequency."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.road_columns import CROSS, KNOWN, WRITTEN, road_columns
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import open_table, spectrum_table, write_spectrum_table
from modeviz.files.tables import Row
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.iso_8608 import fitted_waviness, isotropic_coherence
from modeviz.vehicle.loads import Road

COHERENCE_EXCESS = 1e-3
"""How far above one the squared coherence of two tracks is for rounding: with numbers of five digits it
can be 2e-4."""


@dataclass(frozen=True, eq=False)
class RoadTable:
    """What a table says of a road."""

    file: str
    is_spatial: bool
    """Whether its frequencies are cycles/m and its spectra m²/(cycle/m), and not Hz and m²/Hz."""
    frequency: Floats
    """(n_freqs,), rising, above zero."""
    tracks: Floats
    """(2, n_freqs): the spectra of left and right."""
    cross: Complexes | None
    """(n_freqs,), S_lr; None: the table does not say."""

    def road(
        self,
        name: str,
        label: str,
        speed: float | None,
        track_width: float,
        note: Callable[[str], None],
    ) -> Road:
        """The road.

        What a table does not say of its two tracks is taken as it is in an isotropic surface.

        Args:
            name: see `Road`, like label.
            label: of the road.
            speed: at which the spectra were met, m/s; None for those along the road.
            track_width: m.
            note: told what is taken so.

        Raises:
            VehicleError: a speed is missing, or one too many; or no road.
        """
        if self.is_spatial and speed is not None:
            raise VehicleError(f"speed: {self.file} is over cycles/m, which need none; leave it out")
        if not self.is_spatial and speed is None:
            raise VehicleError(f"speed: missing, expected that at which {self.file} was met")
        speed = 1.0 if speed is None else speed
        left, right = self.tracks
        cross = self.cross
        if cross is None:
            waviness = fitted_waviness(self.frequency, (left + right) / 2)
            cross = np.sqrt(left * right) * isotropic_coherence(
                self.frequency / speed, track_width, waviness
            )
            if track_width:
                note(
                    f"{self.file}: without a cross spectrum the tracks are taken as two of a surface "
                    f"alike in all directions, {track_width:.3g} m apart, of waviness {waviness:.2g}"
                )
        spectrum = np.array([[left, cross], [np.conj(cross), right]], complex).transpose(2, 0, 1)
        with located(self.file):
            return Road(name, label, speed, self.frequency, spectrum)


def read_road(path: Path, conventions: Conventions, note: Callable[[str], None]) -> RoadTable:
    """The table of a road in a file.

    Args:
        path: of the file.
        conventions: in whose length² per Hz, or length³, the spectra are, unless their header says a
            unit.
        note: told what was left out or is likely wrong.

    Raises:
        VehicleError: no such file, or no road; the text names line and column.
    """
    table = open_table(path, note, (), KNOWN, lambda units: road_columns(units, conventions))
    with located(path):
        columns = road_columns(table.units, conventions)
        signed = [name for name in columns.factors if name in CROSS]
        found = spectrum_table(table, path.name, columns.factors, signed, note)
        by_name = dict(zip(list(columns.factors)[1:], found.values.T, strict=True))
        left, right = (by_name[name] for name in columns.tracks)
        cross = None
        if "coherence" in by_name:
            _check_coherence(found.rows, by_name["coherence"])
            cross = np.sqrt(np.minimum(by_name["coherence"], 1) * left * right).astype(complex)
        elif signed:
            cross = _coherent(found.rows, left, right, by_name[CROSS[0]] + 1j * by_name[CROSS[1]])
        return RoadTable(
            path.name, columns.is_spatial, found.frequency_hz, np.array([left, right]), cross
        )


def write_road(path: Path, road: Road) -> None:
    """Writes the spectra in m²/Hz; every number reads back to the same bits."""
    S = road.spectrum
    S_lr = S[:, 0, 1]
    values = (road.frequency_hz, S[:, 0, 0].real, S[:, 1, 1].real, S_lr.real, S_lr.imag)
    write_spectrum_table(path, WRITTEN, values)


def _check_coherence(rows: tuple[Row, ...], squared: Floats) -> None:
    """Raises VehicleError for a squared coherence that is above one, by more than rounding."""
    wrong = np.flatnonzero(squared > 1 + COHERENCE_EXCESS)
    if wrong.size:
        row = rows[wrong[0]]
        raise VehicleError(
            f"{row.where('coherence')}: found {row.cells['coherence']}, expected 0 to 1, the "
            "square |S_lr|² / (S_l S_r)"
        )


def _coherent(rows: tuple[Row, ...], left: Floats, right: Floats, cross: Complexes) -> Complexes:
    """The cross spectrum, with a coherence that is above one by rounding made one."""
    most, found = left * right, np.abs(cross) ** 2
    wrong = np.flatnonzero(found > most * (1 + COHERENCE_EXCESS))
    if wrong.size:
        i = wrong[0]
        raise VehicleError(
            f"line {rows[i].line}, columns {CROSS[0]} and {CROSS[1]}: found a coherence above one, "
            f"{found[i]:.5g} m⁴/Hz² as their square beside {most[i]:.5g} as left times right"
        )
    above = found > most
    ratio = np.sqrt(np.divide(most, found, out=np.ones_like(most), where=above))
    return cross * ratio

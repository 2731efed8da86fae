"""A prepared vehicle that something shakes, solved at lines of its band or between them."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.latest import Latest
from modeviz.analysis.preparation import Prepared
from modeviz.dynamics.reanalysis import Receptances
from modeviz.dynamics.resonances import Resonances
from modeviz.dynamics.response import direct_response
from modeviz.ride.excitation import Excitation, Load, excitation, known_part, together
from modeviz.ride.resolution import resolving_lines
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import RandomLoad

FEW_SPRINGS = 60
"""That are solved for, at all lines at once, sooner than the equations of motion line by line."""


@dataclass(frozen=True, eq=False)
class Driven:
    """A prepared vehicle and its excitation: all of a response that does not depend on mount rates."""

    prepared: Prepared
    loads: tuple[Load, ...]
    speed: float
    """On a road, m/s."""
    receptances: Receptances
    """Of every output, per unit of each input, at lines that hold what the loads' spectra say."""
    latest: Latest[Receptances] = field(default_factory=Latest, init=False)
    """The same between these, for the next rates that want the same lines."""

    latest_whole: Latest[Receptances] = field(default_factory=Latest, init=False)
    """The same with all springs, whichever change."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): the lines of the band, as far as the excitation is known."""
        return self.receptances.frequency_hz

    def lines(self, resonances: Resonances) -> Floats:
        """The lines at which a response is to be solved, (n_lines,), closer where a mode is sharp."""
        return self.prepared.lines(resonances, self.frequency_hz)

    def response(self, stiffness: Complexes, lines: Floats) -> Complexes:
        """Displacement of every output per unit of each load, (n_lines, n_outputs, n_loads).

        Structural modification solves for the springs that change, the equations of motion for all
        coordinates: that is cheaper only where these are fewer, a few rigid bodies on many mounts.

        Args:
            stiffness: (n_springs,), complex rates, N/m.
            lines: (n_lines,), Hz, as of `lines`.

        Raises:
            SolveError: with these rates an undamped resonance lies on a line.
        """
        prepared = self.prepared
        if len(self.receptances.changed(stiffness)) > max(prepared.system.n_dofs, FEW_SPRINGS):
            return self.exact_response(stiffness, lines)
        kept, place = self._on_band(lines)
        on_band = self.receptances.response(stiffness)
        if kept.all():
            return on_band[place]
        H = np.empty((len(lines), *on_band.shape[1:]), complex)
        changed = prepared.between.known.changed(stiffness)
        between = self._between(lines[~kept], changed)
        H[kept], H[~kept] = on_band[place[kept]], between.response(stiffness[changed])
        return H

    def stretches(self, stiffness: Complexes, lines: Floats) -> Complexes:
        """Stretch of every mount spring per unit of each load, (n_lines, n_springs, n_loads).

        Less what the ground moves; arguments and errors as `response`.
        """
        kept, place = self._on_band(lines)
        on_band = self.receptances.stretches(stiffness)
        if kept.all():
            return on_band[place]
        joined = np.empty((len(lines), *on_band.shape[1:]), complex)
        between = self.latest_whole.get(lines.tobytes(), lambda: self._interpolated(lines[~kept], None))
        joined[kept], joined[~kept] = on_band[place[kept]], between.stretches(stiffness)
        return joined

    def response_gradient(
        self, stiffness: Complexes, lines: Floats
    ) -> tuple[Complexes, Complexes, Complexes]:
        """The response and what its derivatives are made of, see `Receptances.response_gradient`.

        Arguments and errors as `response`.
        """
        kept, place = self._on_band(lines)
        on_band = self.receptances.response_gradient(stiffness)
        if kept.all():
            H, a, b = on_band
            return H[place], a[place], b[place]
        H, a, b = (np.empty((len(lines), *values.shape[1:]), complex) for values in on_band)
        between = self._between(lines[~kept]).response_gradient(stiffness)
        for joined, some, others in zip((H, a, b), on_band, between, strict=True):
            joined[kept], joined[~kept] = some[place[kept]], others
        return H, a, b

    def exact_response(self, stiffness: Complexes, lines: Floats) -> Complexes:
        """Return the response from the full model's equations of motion, as `direct_response`."""
        prepared = self.prepared
        system = prepared.system.with_springs(stiffness - prepared.basis.mount_stiffness)
        there = self.receptances.law.stiffness(stiffness, lines)
        forces = prepared.input_directions.T @ self._inputs(lines, there).forces
        return direct_response(system, lines, forces, prepared.outputs)

    def _inputs(self, lines: Floats, stiffness: Complexes) -> Excitation:
        """Return what the loads do at lines with mount rates."""
        vehicle = self.prepared.vehicle
        return together(
            [excitation(vehicle, load, lines, self.speed, stiffness) for load in self.loads]
        )

    def at(self, lines: Floats) -> Receptances:
        """Receptances at lines, (n_lines,)."""
        (known, kept), *others = self.parts(lines)
        return known.merged(others[0][0], kept) if others else known

    def parts(self, lines: Floats) -> list[tuple[Receptances, NDArray[np.bool_]]]:
        """Receptances at those of some lines, (n_lines,), that are of the band, then at the others.

        With each, which lines these are, (n_lines,); the others only if there are some.
        """
        kept, place = self._on_band(lines)
        here = place[kept]
        known = self.receptances if len(here) == len(self.frequency_hz) else self.receptances.at(here)
        if kept.all():
            return [(known, kept)]
        return [(known, kept), (self._interpolated(lines[~kept], None), ~kept)]

    def _on_band(self, lines: Floats) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
        """Return which lines are of the band, and where in it."""
        place = np.minimum(np.searchsorted(self.frequency_hz, lines), len(self.frequency_hz) - 1)
        return self.frequency_hz[place] == lines, place

    def _between(self, lines: Floats, springs: NDArray[np.intp] | None = None) -> Receptances:
        """Receptances of some springs, or all, at lines between those of the band."""
        key = lines.tobytes(), None if springs is None else springs.tobytes()
        return self.latest.get(key, lambda: self._interpolated(lines, springs))

    def _interpolated(self, lines: Floats, springs: NDArray[np.intp] | None) -> Receptances:
        """Return the same, found anew."""
        between = self.prepared.between
        inputs = self._inputs(lines, between.known.present_at(lines))
        used = np.flatnonzero(inputs.forces.any(axis=(0, 2)))
        ground = inputs.ground if springs is None else inputs.ground[:, springs]
        return between.at(lines, springs, used).driven(inputs.forces[:, used], ground)


def driven(
    prepared: Prepared, loads: Sequence[Load], speed: float, lines: Floats | None = None
) -> Driven:
    """A prepared vehicle under loads, at lines of its band or between them; at those of it if None."""
    on_band = Driven(prepared, tuple(loads), speed, prepared.excited(loads, speed))
    if lines is None or np.array_equal(lines, prepared.frequency_hz):
        return on_band
    return replace(on_band, receptances=on_band.at(lines))


def load_lines(prepared: Prepared, loads: Sequence[tuple[RandomLoad, float]]) -> Floats:
    """Lines at which some loads, each with the speed on a road in m/s, are to be solved, (n_lines,).

    Raises:
        ModevizError: nothing of the band is known of a load.
    """
    if prepared.is_graded:
        return resolving_lines(prepared.vehicle, loads, prepared.frequency_hz)
    parts = [known_part(load, prepared.frequency_hz, speed) for load, speed in loads]
    return prepared.frequency_hz[min(p.start for p in parts) : max(p.stop for p in parts)]

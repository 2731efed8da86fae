"""What of a response comes through which connection.

A body is cut free of all that joins it. What joined it then is a force on it like any other, and the
response at a point is exactly the sum

    y = Σ_p a R_pᵀ (-F_p) + a F_loads,  a = P Z_b⁻¹

of the force of each connection and direction times the body's own receptance between there and the
point, and of what loads do that act on the body itself (transfer path analysis in its component-based
form; M. V. van der Seijs, D. de Klerk, D. J. Rixen, "General framework for transfer path analysis",
Mechanical Systems and Signal Processing 68-69, 2016).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeviz.mounting.forces import N_MOTIONS, Forces
from modeviz.mounting.free_bodies import free_response
from modeviz.mounting.levels import InputSpectra
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS, Connection

By = Literal["mount", "direction", "body", "group"]
"""How paths are taken together: by connection, not at all, by the body at the other end, by group."""

LOADS = "loads on the body"
"""The path of what acts on the body itself."""

MODE_DAMPING = "damping of modes"
"""The path of what damps single modes of the vehicle, which no connection does."""


@dataclass(frozen=True)
class Path:
    """One direction of one connection, or what acts on the body otherwise."""

    connection: str
    """Its name; `LOADS` or `MODE_DAMPING`."""
    group: str
    """Of the connection; "" of what is none."""
    body: str
    """What is at its other end: a body or the ground; "" of what is no connection."""
    direction: str
    """One of `MOTIONS`, along or about the connection's local axes; "" of what is no connection."""

    def called(self, by: By) -> str:
        """What it is called among others taken together so; paths of one name are one."""
        match by:
            case "mount":
                return self.connection
            case "direction":
                return f"{self.connection} {self.direction}".rstrip()
            case "body":
                return self.body or self.connection
            case "group":
                return self.group or self.connection


@dataclass(frozen=True, eq=False)
class Paths:
    """The parts that make a response, each per unit of each input of a load."""

    frequency_hz: Floats
    """(n_freqs,)."""
    paths: tuple[Path, ...]
    parts: Complexes
    """(n_freqs, n_paths, n_inputs), m: they add up to the response."""

    @property
    def response(self) -> Complexes:
        """The displacement that they make, (n_freqs, 1, n_inputs), m."""
        return self.parts.sum(axis=1, keepdims=True)

    def together(self, by: By) -> "Paths":
        """The same, but paths of one name as one, which stands for the first of them."""
        names = [path.called(by) for path in self.paths]
        every = list(dict.fromkeys(names))
        is_of = np.array([[name == each for name in names] for each in every], float)
        first = tuple(self.paths[names.index(name)] for name in every)
        return Paths(self.frequency_hz, first, is_of @ self.parts)

    def shares(self, spectra: InputSpectra) -> Floats:
        """The share of each path in the response, (n_freqs, n_paths): they add up to one.

        Re S_py / S_yy: what of the response's power is coherent with that path (J. S. Bendat, A. G.
        Piersol, "Random Data", 4th ed., ch. 7); under a harmonic load Re (p y*) / |y|², the path's
        phasor along the response. Negative where a path works against the others. Zeros where
        nothing moves.
        """
        power = spectra.psd(self.response)
        cross = spectra.cross(self.parts, self.response)
        return np.divide(cross, power, out=np.zeros_like(cross), where=power > 0)

    def alone(self, spectra: InputSpectra) -> Floats:
        """√(S_pp / S_yy): the size of each path by itself beside the response's, (n_freqs, n_paths)."""
        power = spectra.psd(self.response)
        own = spectra.psd(self.parts)
        return np.sqrt(np.divide(own, power, out=np.zeros_like(own), where=power > 0))

    def total_shares(self, spectra: InputSpectra) -> Floats:
        """The share of each path in the mean square of the acceleration over all lines, (n_paths,).

        ∫ ω⁴ Re S_py df / ∫ ω⁴ S_yy df: they add up to one.
        """
        weights = (2 * np.pi * self.frequency_hz) ** 4
        whole = spectra.total(self.response, self.response, weights)
        return spectra.total(self.parts, self.response, weights) / (whole if whole > 0 else np.inf)


def solve_paths(forces: Forces, body: str, reading: Floats) -> Paths:
    """The paths to a response of a body.

    Args:
        forces: of all connections.
        body: its name.
        reading: row (n,) that reads the response from the body's own coordinates.
    """
    system, f = forces.system, forces.frequency_hz
    own = system.dofs[body]
    a = free_response(system, body, f, reading[:, None])[:, :, 0]
    joined = _joined(forces, body)
    numbers = np.concatenate([np.zeros(0, int), *(n for _, n in joined)])
    through = -(a @ system.connection_motions[numbers][:, own].T)[:, :, None] * forces.force[:, numbers]
    parts, paths = [through], [_path(c, body, n) for c, every in joined for n in every]
    damped = system.mode_dampers[:, own] if len(system.mode_damping) else np.zeros((0, len(reading)))
    for name, on_body in (
        (MODE_DAMPING, -(damped.T @ forces.mode_damping)),
        (LOADS, forces.loads[:, own]),
    ):
        if on_body.any():
            parts.append(np.einsum("fn,fni->fi", a, on_body)[:, None])
            paths.append(Path(name, "", "", ""))
    return Paths(f, tuple(paths), np.concatenate(parts, axis=1))


def _joined(forces: Forces, body: str) -> list[tuple[Connection, list[int]]]:
    """The connections of a body, and the numbers of the motions in which each acts."""
    acting = forces.acting
    return [
        (c, [n for n in range(N_MOTIONS * i, N_MOTIONS * (i + 1)) if acting[n]])
        for i, c in enumerate(forces.connections)
        if body in c.bodies
    ]


def _path(connection: Connection, body: str, number: int) -> Path:
    first, second = connection.bodies
    other = second if first == body else first
    return Path(connection.name, connection.group, other, MOTIONS[number % N_MOTIONS])

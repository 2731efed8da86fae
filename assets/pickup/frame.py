"""The ladder frame: two rails, nine crossmembers and their brackets, all beams."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from modeviz.fem.mesh import BeamSection
from pickup import box
from pickup.half_mesh import HalfMesh, Structure
from pickup.parameters import Parameters
from pickup.sections import BRACKET, POISSON, STEEL, STEEL_DENSITY, box_member
from pickup.sides import Place

RAIL = (
    (-0.88, 0.36, 0.50),
    (-0.55, 0.36, 0.52),
    (-0.25, 0.37, 0.50),
    (0.00, 0.38, 0.50),
    (0.30, 0.39, 0.48),
    (0.60, 0.41, 0.45),
    (0.95, 0.43, 0.44),
    (1.25, 0.44, 0.44),
    (1.60, 0.45, 0.44),
    (1.90, 0.46, 0.45),
    (2.30, 0.47, 0.50),
    (2.62, 0.48, 0.60),
    (2.98, 0.48, 0.64),
    (3.34, 0.48, 0.62),
    (3.75, 0.48, 0.58),
    (4.15, 0.48, 0.58),
)
"""Stations of the right rail's centre line, m."""
CROSSMEMBERS = (0, 3, 4, 7, 9, 10, 11, 13, 15)
"""Stations that have one."""
SUSPENSION_CROSSMEMBER = 3
ENGINE_CROSSMEMBER = 4
BOX_STATIONS = (10, 11, 13, 15)

SUSPENSION_BRACKETS = (
    (-0.14, 0.34, 0.36),
    (0.16, 0.34, 0.36),
    (-0.10, 0.46, 0.63),
    (0.16, 0.46, 0.63),
    (0.00, 0.56, 0.60),
    (-0.16, 0.30, 0.42),
)
"""Lower arm, upper arm, coil seat, relay rod."""
ENGINE_BRACKET = (0.18, 0.26, 0.68)
CAB_FRONT_BRACKET = (0.97, 0.66, 0.56)
CAB_REAR_BRACKET = (1.95, 0.66, 0.56)

RAIL_ELEMENT = 0.075
CROSSMEMBER_ELEMENT = 0.05
"""m, about how long an element is."""


def frame(parameters: Parameters) -> Structure:
    """The frame's finite-element mesh, with bumpers."""
    half = HalfMesh()
    stations = _rail(half, rail_section(parameters))
    crossmembers = _crossmembers(half, stations, parameters)
    suspension = stations[SUSPENSION_CROSSMEMBER]
    for tip in SUSPENSION_BRACKETS:
        half.add_bracket(suspension, tip, BRACKET)
    beside_engine = min(
        crossmembers[ENGINE_CROSSMEMBER], key=lambda n: abs(half.nodes[n][1] - ENGINE_BRACKET[1])
    )
    engine = half.add_bracket(beside_engine, ENGINE_BRACKET, BRACKET)
    half.add_beam(stations[ENGINE_CROSSMEMBER], engine, BRACKET, up=(0.3, 0.2, 1.0))
    half.hang_mounts_on(
        engine,
        half.add_bracket(stations[6], CAB_FRONT_BRACKET, BRACKET),
        half.add_bracket(stations[9], CAB_REAR_BRACKET, BRACKET),
    )
    for station, tip in zip(BOX_STATIONS, box.BRACKETS, strict=True):
        half.add_bracket(stations[station], tip, BRACKET)
    half.add_mass(stations[0], 14.0, offset=(-0.08, 0.1, 0.02), inertia=(0.0, 1.0, 4.0))  # bumpers
    half.add_mass(stations[-1], 8.0, offset=(0.06, 0.1, 0.0), inertia=(0.0, 0.5, 2.0))
    return half.mirrored()


def rail_section(parameters: Parameters) -> BeamSection:
    """A C section, boxed over part of its length, with lines and harness.

    The torsion constant is 60 times the open section's: what closing plates and joints make of it.
    """
    w, h, t = 0.070, 0.165, 0.0042
    shift = w**2 / (2 * w + h)  # of the centroid from the web
    flanges = 2 * (t * w**3 / 12 + w * t * (w / 2 - shift) ** 2)
    return BeamSection(
        area=(2 * w + h) * t,
        bending_inertia_up=(t * h**3 / 12 + 2 * w * t * (h / 2) ** 2)
        * parameters.rail_vertical_bending_factor,
        bending_inertia_across=(flanges + h * t * shift**2) * parameters.rail_lateral_bending_factor,
        torsion_constant=60 * (2 * w + h) * t**3 / 3 * parameters.rail_torsion_factor,
        youngs_modulus=STEEL,
        poisson_ratio=POISSON,
        density=STEEL_DENSITY,
        added_mass=8.0,
    )


def crossmember_section(parameters: Parameters, strength: float, added_mass: float) -> BeamSection:
    """A box section; half of its torsion constant is lost in the riveted ends."""
    tube = box_member(0.09, 0.09, 0.0032)
    bending = parameters.crossmember_bending_factor * strength
    return replace(
        tube,
        bending_inertia_up=tube.bending_inertia_up * bending,
        bending_inertia_across=tube.bending_inertia_across * bending,
        torsion_constant=tube.torsion_constant * parameters.crossmember_torsion_factor * strength / 2,
        added_mass=added_mass,
    )


def _rail(half: HalfMesh, section: BeamSection) -> list[int]:
    """Lays the rail; returns the nodes at its stations."""
    stations = [half.add_node(RAIL[0])]
    for start, end in pairwise(RAIL):
        inner = [half.add_node(p) for p in _between(start, end, RAIL_ELEMENT)]
        nodes = [stations[-1], *inner, half.add_node(end)]
        _chain(half, nodes, section)
        stations.append(nodes[-1])
    return stations


def _crossmembers(half: HalfMesh, stations: list[int], parameters: Parameters) -> dict[int, list[int]]:
    """Lays the crossmembers from the centre line to the rail; returns their nodes by station."""
    crossmembers = {}
    for station in CROSSMEMBERS:
        x, _, z = RAIL[station]
        front = station == SUSPENSION_CROSSMEMBER
        section = crossmember_section(parameters, 4.0 if front else 1.0, 18.0 if front else 0.0)
        inner = [half.add_node(p) for p in _between((x, 0, z), RAIL[station], CROSSMEMBER_ELEMENT)]
        nodes = [half.add_node((x, 0, z)), *inner, stations[station]]
        _chain(half, nodes, section)
        crossmembers[station] = nodes
    return crossmembers


def _chain(half: HalfMesh, nodes: list[int], section: BeamSection) -> None:
    for a, b in pairwise(nodes):
        half.add_beam(a, b, section, up=(0, 0, 1))


def _between(start: Place, end: Place, length: float) -> np.ndarray:
    """The inner points that divide a line into elements of about that length."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    n = max(1, round(float(np.linalg.norm(b - a)) / length))
    return a + (b - a) * (np.arange(1, n) / n)[:, None]

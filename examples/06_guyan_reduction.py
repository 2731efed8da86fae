"""How few degrees of freedom does a frame need?

A. E. Duncan condenses every component to 5 to 10 % of its degrees of freedom before it is solved for
its modes: the others follow statically (Guyan). What is retained is chosen here so that all the rest,
held there, vibrates above some frequency. What does that cost a ladder frame of beams, and what does
the reduction itself say of it? It needs the extra `fem`.
"""

from itertools import pairwise

import numpy as np

import modeviz as mv
from modeviz.fem.attachments import OnNode
from modeviz.fem.component import body_from_matrices
from modeviz.fem.free import free_modes
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import BeamSection, FiniteElementMesh
from modeviz.fem.reduction import GuyanReduction, guyan_reduction, retained_up_to

TUBE = BeamSection(
    area=1.1e-3,
    bending_inertia_up=2.6e-6,
    bending_inertia_across=0.9e-6,
    torsion_constant=1.6e-6,
    youngs_modulus=2.1e11,
    poisson_ratio=0.3,
    density=7850.0,
)
N_ALONG, N_ACROSS = 40, 8
"""Beams in a rail of 4 m, and in each of five cross members of 0.8 m between the rails."""


def ladder() -> FiniteElementMesh:
    """The two rails and five cross members of a frame."""
    x = np.linspace(0, 4, N_ALONG + 1)
    rails = [np.stack([x, np.full_like(x, y), np.zeros_like(x)], axis=1) for y in (-0.4, 0.4)]
    right = len(x)
    beams = [(i, i + 1) for first in (0, right) for i in range(first, first + N_ALONG)]
    inner = np.linspace(-0.4, 0.4, N_ACROSS + 1)[1:-1]
    nodes = np.vstack(rails)
    for at in range(0, N_ALONG + 1, N_ALONG // 4):
        chain = [at, *range(len(nodes), len(nodes) + len(inner)), right + at]
        beams += pairwise(chain)
        nodes = np.vstack([nodes, [[x[at], y, 0.0] for y in inner]])
    up = np.tile([0.0, 0.0, 1.0], (len(beams), 1))
    return FiniteElementMesh(
        nodes, beams=np.array(beams), beam_sections=(TUBE,) * len(beams), beam_up=up
    )


frame = assemble(ladder())
corners = {
    "front left": 0,
    "rear left": N_ALONG,
    "front right": N_ALONG + 1,
    "rear right": 2 * N_ALONG + 1,
}
held = [6 * node + i for node in corners.values() for i in range(3)]
full_hz = np.sqrt(free_modes(frame, 14).omega_n_squared[6:]) / (2 * np.pi)

reductions: dict[float, GuyanReduction] = {
    hz: guyan_reduction(frame, retained_up_to(frame, hz, always=held)) for hz in (150.0, 300.0, 600.0)
}
modes = {hz: free_modes(reduction.matrices, 14) for hz, reduction in reductions.items()}
reduced_hz = {hz: np.sqrt(found.omega_n_squared[6:]) / (2 * np.pi) for hz, found in modes.items()}

points = [OnNode(name, frame.nodes[node], node) for name, node in corners.items()]
lump = mv.AddedMass("lump", "frame", frame.nodes[0], 100.0)
torsion_hz = {}
for name, matrices in (("full", frame), ("reduced", reductions[300.0].matrices)):
    body = body_from_matrices("frame", "frame", "frame", matrices, points, 14, damping_ratio=0.01)
    loaded = mv.Study(mv.Vehicle("a frame with a lump on a corner", (body,), (), added_masses=(lump,)))
    torsion_hz[name] = loaded.modes()["first torsion"].frequency_hz

if __name__ == "__main__":
    for hz, reduction in reductions.items():
        found = reduced_hz[hz]
        low, too_high = reduction.at_least_hz(found), reduction.too_high(modes[hz])[6:]
        print(f"\nthe rest above {hz:.0f} Hz: {len(reduction.retained)} of {frame.n_dofs} retained")
        print("full, Hz   reduced   at least   error   said")
        for row in zip(full_hz, found, low, found / full_hz - 1, too_high, strict=True):
            print("{:8.2f} {:9.2f} {:10.2f} {:7.2%} {:6.2%}".format(*row))
    print("\nfirst torsion with 100 kg on a corner, Hz:", torsion_hz)

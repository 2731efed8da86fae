"""Modes as universal files are what pyuff and other readers find there, and come back."""

import numpy as np
import pytest
import pyuff
from joined_networks import GROUNDED, RATES, joined_networks
from two_networks import ATTACHED, joined_frequencies, place

from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.files import read_vehicle
from modeviz.study.study import Study

DIGITS = 5.1e-6
"""Relative: half of the sixth digit of a number."""

SET = {".unv": 2414, ".uff": 55}


@pytest.fixture(scope="module")
def vehicle(tmp_path_factory):
    return joined_networks(tmp_path_factory.mktemp("networks"))


@pytest.fixture(scope="module")
def study(vehicle):
    return Study(vehicle)


def sets(path, kind):
    every = pyuff.UFF(str(path)).read_sets()
    return [one for one in every if one["type"] == kind]


def parameters(mode):
    """Frequency, modal mass and damping ratio of either data set."""
    if mode["type"] == 55:
        return mode["freq"], mode["modal_m"], mode["modal_damp_vis"]
    return tuple(mode[f"record12_field{field}"] for field in (2, 4, 5))


def motions(mode):
    """(n_nodes, 6) as pyuff reads either data set."""
    if mode["type"] == 55:
        return np.column_stack([mode[f"r{i}"] for i in range(1, 7)])
    return np.array([*mode["data_at_node"]])

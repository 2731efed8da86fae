"""Files with matrices, damaged at random: whatever comes of it is a component or one sentence."""

import io
import random
import warnings

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp
from free_network import CORNERS, LABELS, free_network
from op4_files import dmig, op4_binary, op4_text
from test_abaqus_matrices import by_labels, entries, substructure
from test_random_damage import damaged

from modeviz.errors import ModevizError
from modeviz.formats.reading import read_component
from modeviz.formats.solving import Wanted, solved

NETWORK = free_network()
M, K = NETWORK.mass, NETWORK.stiffness
DIRECTIONS = np.column_stack([np.repeat(LABELS, 3), np.tile([1, 2, 3], 8)])
PLACES = list(zip(LABELS, CORNERS, strict=True))
TABLE = "".join(f"{n},{x},{y},{z},123\n" for n, (x, y, z) in PLACES).encode()
DECK = "".join(f"GRID,{n},,{x},{y},{z}\n" for n, (x, y, z) in PLACES)
EXTERNAL = "".join(f"EXTRN,{n},123\n" for n in LABELS)
CARDS = DECK + dmig("KAAX", K, DIRECTIONS) + dmig("MAAX", M, DIRECTIONS)
BOTH = {"KXX": K, "MXX": M}


def written(write, *arguments, **options):
    content = io.BytesIO()
    write(content, *arguments, **options)
    return content.getvalue()


SPARSE = {"K": sp.csc_array(K), "M": sp.csc_array(M)}
MARKET = {
    f"{name}.mtx": written(scipy.io.mmwrite, A, symmetry="symmetric") for name, A in SPARSE.items()
}
NPZ = {f"{name}.npz": written(sp.save_npz, A) for name, A in SPARSE.items()}
SOURCES = [
    {"a.npz": written(np.savez, K=K, M=M), "n.csv": TABLE},
    {**NPZ, "n.csv": TABLE},
    {**MARKET, "n.csv": TABLE},
    {"n.csv": TABLE, **MARKET},
    {"a.mat": written(scipy.io.savemat, SPARSE), "n.csv": TABLE},
    {"a.mat": written(scipy.io.savemat, {"K": K, "M": M}, do_compression=True), "n.csv": TABLE},
    {"a.op4": op4_binary(BOTH, "strings"), "s.pch": (EXTERNAL + DECK).encode()},
    {"a.op4": op4_binary(BOTH, "wide", ">", 8), "s.pch": (EXTERNAL + DECK).encode()},
    {"a.op4": op4_text(BOTH), "s.pch": (EXTERNAL + DECK).encode()},
    {"s.pch": (EXTERNAL + DECK).encode(), "a.op4": op4_text(BOTH, "wide")},
    {"a.pch": CARDS.encode()},
    {"a.mtx": substructure().encode(), "n.csv": TABLE},
    {"K.mtx": entries(K, by_labels).encode(), "M.mtx": entries(M, by_labels).encode(), "n.csv": TABLE},
]
"""By name, of which the first is damaged."""


@pytest.mark.parametrize("source", range(len(SOURCES)))
def test_files_damaged_at_random_end_in_a_component_or_one_sentence(tmp_path, source):
    chance = random.Random(source)
    files = SOURCES[source]
    first = next(iter(files))
    for name, content in files.items():
        (tmp_path / name).write_bytes(content)
    paths = [tmp_path / name for name in files]
    said = []
    for _ in range(30):
        (tmp_path / first).write_bytes(damaged(files[first], chance))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                solved(read_component(paths), Wanted(n_modes=12))
            except ModevizError as error:
                said.append(str(error))
    assert said
    assert not any("\n" in sentence for sentence in said)

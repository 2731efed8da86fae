"""The process that reads one of Ansys's files: `python extract.py FILE OUTPUT` writes an `.npz`.

It is run as text, see `modeviz.files.own_process`.

It imports nothing of modeviz, so that it starts with the library alone. What it cannot read it says in
a line to standard error, with exit status 1.
"""

import sys

import numpy as np


def main(path: str, output: str) -> None:
    """Writes the arrays of results or of a full file."""
    from ansys.mapdl.reader import read_binary

    file = read_binary(path)
    arrays = _full(file) if path.lower().endswith(".full") else _results(file)
    np.savez(output, allow_pickle=False, **arrays)


def _full(file) -> dict[str, np.ndarray]:
    """Both matrices by entries, and the node and direction, from 0, of each row and of held ones."""
    dofs, stiffness, mass = file.load_km(sort=True)
    arrays = {"dofs": dofs, "held": np.asarray(file.const).reshape(-1, 2)}
    for name, matrix in (("K", stiffness), ("M", mass)):
        entries = matrix.tocoo()
        arrays |= {f"{name}_{part}": getattr(entries, part) for part in ("row", "col", "data")}
    return arrays


def _results(file) -> dict[str, np.ndarray]:
    """Nodes, cells as VTK has them, and modes."""
    header = file._resultheader
    numbers = file.mesh.nnum
    names = file.result_dof(0)
    shapes = np.zeros((file.n_results, len(numbers), len(names)))
    is_whole = True
    for i in range(file.n_results):
        moved, values = file.nodal_solution(i)
        shapes[i, np.searchsorted(numbers, moved)] = values[:, : len(names)]
        is_whole &= len(moved) == len(numbers)
    return {
        "analysis": np.array(int(header["kan"])),
        "is_cyclic": np.array(type(file).__name__ != "Result"),
        "is_complex": np.array(bool(header["cpxrst"])),
        "is_whole": np.array(is_whole),
        "nodes": np.asarray(file.mesh.nodes)[:, :3],
        "numbers": numbers,
        "angles": np.asarray(file.mesh.node_angles),
        "cells": np.asarray(file.grid.cells),
        "kinds": np.asarray(file.grid.celltypes),
        "frequencies": np.asarray(file.time_values),
        "directions": np.array(names),
        "shapes": shapes,
    }


def run(*arguments: str) -> None:
    """Does what `main` does, or ends the program with a line on what was wrong."""
    try:
        main(*arguments)
    except ImportError as error:
        sys.exit(f"missing: {error}")
    except MemoryError:
        sys.exit("memory")
    except Exception as error:
        sys.exit(f"{type(error).__name__}: {error}")


if __name__ == "__main__":
    run(*sys.argv[1:])

import numpy as np
import pytest
from small_meshes import twisted_plate

from modeviz.fem.free import free_modes
from modeviz.fem.matrices import assemble


@pytest.fixture(scope="session")
def body():
    return assemble(twisted_plate())


@pytest.fixture(scope="session")
def modes(body):
    return free_modes(body, 16)


@pytest.fixture(scope="session")
def loads(body):
    """Forces and couples at four nodes, none of them balanced; two are the same."""
    f = np.zeros((body.n_dofs, 6))
    f[[2, 6 * 48 + 2, 6 * 24, 6 * 30 + 3, 6 * 6 + 1, 2], np.arange(6)] = 1.0
    return f

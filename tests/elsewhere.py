"""pyyeti's modules, which are nobody's here, imported as they are first used: that takes seconds.

As pyyeti is imported it changes how NumPy prints, which is undone.
"""

from importlib import import_module

import numpy as np


def __getattr__(name):
    with np.printoptions():
        return import_module(f"pyyeti.nastran.{name}")

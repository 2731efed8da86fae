"""pyyeti, which is nobody's here: as it is imported it changes how NumPy prints, which is undone."""

import numpy as np

with np.printoptions():
    from pyyeti.nastran import bulk as bulk
    from pyyeti.nastran import op4 as op4

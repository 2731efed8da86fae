"""Limits on the size of a display mesh, checked before it takes memory or time."""

from modeviz.files.limits import VARIABLE as VARIABLE
from modeviz.files.limits import check_size as check_size

LARGEST_FILE = 256_000_000
"""Bytes."""

LARGEST_TEXT = 128_000_000
"""Bytes of a file whose numbers are text."""

LARGEST_DOCUMENT = 16_000_000
"""Bytes of a glTF's JSON, which takes ten times as much memory, and of files beside a mesh."""

MOST_POINTS = 1_000_000
"""Vertices of a file, and faces: what a page still turns."""

MOST_PARTS = 10_000
"""Parts of a file, each of which a page draws by itself."""

MOST_PIXELS = 100_000_000
"""Pixels of all textures of a file."""

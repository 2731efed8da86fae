"""`python -m modeviz`."""

import sys

from modeviz.cli import main

sys.exit(main())

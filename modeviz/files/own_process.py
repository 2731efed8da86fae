"""Commands for Python code that is run beside this program, with no more than some memory.

What libraries in C++ do with a damaged file is theirs: crash, take all memory, or not end.
"""

import sys

LIMITED = """
import os
import sys
os.environ["OPENBLAS_NUM_THREADS"] = "1"
try:
    import resource
    resource.setrlimit(resource.RLIMIT_AS, ({0}, {0}))
except (ImportError, OSError, ValueError):
    pass
"""
"""What the code begins with; Windows has no such limit. Each of many threads would take 40 MB of it."""


def own_process(code: str, most_bytes: int, *arguments: str) -> list[str]:
    """Return the command that runs code with arguments, which it finds in `sys.argv`.

    Args:
        code: of a program, in whole.
        most_bytes: of memory that it may take, where the system can hold a process to them.
        arguments: after the first, which is "-c".
    """
    return [sys.executable, "-P", "-c", LIMITED.format(most_bytes) + code, *arguments]

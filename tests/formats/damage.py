"""Ways to damage the bytes of a file, and what is asked of a command that is given one."""

import resource
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path

MOST_SECONDS, MOST_KILOBYTES = 10, 2_000_000

Damage = Callable[[bytes], bytes]


def cut(part: float) -> Damage:
    return lambda content: content[: int(part * len(content))]


def exchanged(old: bytes | str, new: bytes | str, count: int = 1) -> Damage:
    """The file with the first of something replaced, which has to be there."""
    old, new = (v.encode() if isinstance(v, str) else v for v in (old, new))

    def damage(content: bytes) -> bytes:
        assert old in content
        return content.replace(old, new, count)

    return damage


def at(place: int, new: bytes) -> Damage:
    return lambda content: content[:place] + new + content[place + len(new) :]


def swapped(content: bytes) -> bytes:
    """Every four bytes the other way round."""
    whole = content[: len(content) // 4 * 4]
    return b"".join(whole[i : i + 4][::-1] for i in range(0, len(whole), 4))


@contextmanager
def within_bounds() -> Iterator[None]:
    """Holds what is done to a time and an amount of memory."""
    began, before = time.process_time(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    yield
    assert time.process_time() - began < MOST_SECONDS
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MOST_KILOBYTES


def check_refusal(said: str) -> str:
    """The one sentence with which a command ends, after its notes; it has no trace of a program."""
    lines = said.splitlines()
    assert [line for line in lines if not line.startswith("modeviz: note:")] == lines[-1:]
    assert lines[-1].startswith("modeviz: ")
    assert len(lines[-1]) < 600
    places = [Path(place).name for place in lines[-1].split(": ")]
    assert not [one for one, other in pairwise(places) if one == other]
    return lines[-1]

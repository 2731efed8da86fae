"""What stands around a server: names that it has, proxies before it, pages that show it in a frame."""

import re
from dataclasses import dataclass

from modeviz.errors import ModevizError
from modeviz.viewer.page.wire.forwarded import NO_PROXIES, Proxies, proxies_at

NAME = re.compile(r"[\w.-]+", re.ASCII)
ORIGIN = re.compile(r"https?://(?:[\w.-]+|\[[0-9a-f:.]+\])(?::\d{1,5})?", re.ASCII)
PREFIX = re.compile(r"(?:/[\w.~-]+)*", re.ASCII)


@dataclass(frozen=True)
class Surroundings:
    """How browsers come to a server otherwise than by its own address."""

    public_names: tuple[str, ...] = ()
    """Names of this server besides its own, lower case."""
    frames: tuple[str, ...] = ()
    """Origins, such as https://wiki.example.com, whose pages may show this one in a frame."""
    proxies: Proxies = NO_PROXIES
    """That are believed in what they say of who asked them."""
    prefix: str = ""
    """What stands before the path of every address, such as /bench; a proxy may have taken it off."""

    def local_path(self, path: str) -> str | None:
        """Return a request's path without the prefix; None where it lacks the slash after that."""
        if not self.prefix or not path.startswith(self.prefix):
            return path
        rest = path.removeprefix(self.prefix)
        if rest.startswith("/"):
            return rest
        return path if rest and not rest.startswith("?") else None


NOTHING_AROUND = Surroundings()
"""Browsers come to the server's own address alone."""


def surroundings(
    public_names: tuple[str, ...] = (),
    frames: tuple[str, ...] = (),
    proxies: tuple[str, ...] = (),
    prefix: str = "",
) -> Surroundings:
    """Return what stands around a server, as the command's options say it.

    Args:
        public_names: under which a proxy makes the page known.
        frames: origins of pages that may show it in a frame.
        proxies: addresses and networks of those that are believed.
        prefix: of all paths, from its first slash on.

    Raises:
        ModevizError: one of them is no such thing.
    """
    for name in public_names:
        if not NAME.fullmatch(name):
            raise ModevizError(
                f"--public-name: found {name!r}, expected a name such as tool.example.com"
            )
    origins = tuple(frame.lower().rstrip("/") for frame in frames)
    for given, origin in zip(frames, origins, strict=True):
        if not ORIGIN.fullmatch(origin):
            raise ModevizError(
                f"--allow-frame: found {given!r}, expected an origin such as https://wiki.example.com"
            )
    path = prefix.rstrip("/")
    if not PREFIX.fullmatch(path) or {".", ".."} & set(path.split("/")):
        raise ModevizError(f"--path-prefix: found {prefix!r}, expected a path such as /bench")
    return Surroundings(tuple(map(str.lower, public_names)), origins, proxies_at(proxies), path)

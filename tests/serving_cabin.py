"""A server of the small cabin with as many sessions as come, without a browser."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

from mounted_cabin import mounted_cabin
from visitors import CAMERA, encoded, get, knock, own_origin
from websockets.sync.connection import Connection

from modeviz.analysis.results import Conditions
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.viewer.page.front import Front, open_front
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.directory import Directory


@contextmanager
def serving(study: Path | None = None, **options) -> Iterator[tuple[Front, Directory]]:
    """The front and what is behind it, remembered in a file if one is named."""
    cabin = mounted_cabin()
    front = open_front(**{"port": 0, **options})
    file = study and StudyFile.open(study, cabin.name, fingerprint_of(cabin))
    bench = Bench(cabin, cabin.rates, Conditions("flat", 20.0), study=file)
    with ExitStack() as ending:
        if file:
            ending.callback(file.close)
        directory = Directory(front, {cabin.name: bench}, dark=False)
        ending.callback(directory.close)
        ending.callback(front.close)
        front.open(directory)
        bench.prepared()
        yield front, directory


def way(front: Front, path: str = "/", **headers: str) -> str:
    """Where a request is sent."""
    status, answered, _ = get(front, path, **headers)
    assert status == 303
    return answered["Location"].removeprefix(".")


def key_of(path: str) -> str:
    """The session that an address names."""
    return parse_qs(urlsplit(path).query)["session"][0]


@contextmanager
def page_at(front: Front, path: str) -> Iterator[Connection]:
    """The websocket of a page, which has said where its camera is."""
    with knock(front, own_origin(front), path) as socket:
        socket.send(encoded(CAMERA))
        yield socket

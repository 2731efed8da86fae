"""Shows vehicles to whoever may come, until stopped."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from functools import partial

from modeviz.analysis.results import drive
from modeviz.compute.stop import Stop
from modeviz.compute.threads import one_thread
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import NOTHING_AROUND, Surroundings
from modeviz.viewer.page.front import open_front
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.directory import Directory


def serve(
    benches: Mapping[str, Bench],
    host: str,
    port: int,
    token: Secret | None,
    dark: bool,
    progress: Callable[[float], None] | None = None,
    around: Surroundings = NOTHING_AROUND,
    stop: Stop | None = None,
    is_lazy: bool = False,
) -> None:
    """Shows vehicles until interrupted.

    Args:
        benches: the vehicles, by what addresses call them.
        host: address to listen on.
        port: to listen on.
        token: asked of every visitor, if any.
        dark: whether the pages are dark.
        progress: told the fraction of the preparation that is done.
        around: the server.
        stop: ends it; if not given, only an exception in the main thread does.
        is_lazy: whether there is a start page, and a vehicle is made ready once somebody opens it.

    Raises:
        ModevizError: the port is in use, the address needs a token, or a road does not go with the
            speed.
    """
    with one_thread(), ExitStack() as ending:
        names = ", ".join(bench.vehicle.name for bench in benches.values())
        title = "modeviz" if is_lazy else f"{names} · modeviz"
        front = open_front(host, port, token, title, around)
        directory = Directory(front, benches, dark, has_lobby=is_lazy)
        ending.callback(directory.close)
        ending.callback(front.close)
        front.open(directory)
        verb = "are" if len(benches) > 1 else "is"
        print(f"{names} {verb} at {front.link}  (Ctrl+C ends)", flush=True)
        (stop or Stop()).wait(None if is_lazy else partial(_prepare, benches, progress))


def _prepare(benches: Mapping[str, Bench], progress: Callable[[float], None] | None) -> None:
    """Makes vehicles ready, and sees that there is an answer on the road of new sessions."""
    for bench in benches.values():
        drive(bench.prepared(progress), bench.conditions)

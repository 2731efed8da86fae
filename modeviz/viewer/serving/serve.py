"""Shows vehicles to whoever may come, until stopped."""

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial

from modeviz.analysis.results import Conditions, drive
from modeviz.compute.stop import Stop
from modeviz.compute.threads import one_thread
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.secret import Secret
from modeviz.viewer.page.server import open_front
from modeviz.viewer.page.surroundings import NOTHING_AROUND, Surroundings
from modeviz.viewer.serving.bench import Bench
from modeviz.viewer.serving.directory import Directory


def serve(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    host: str,
    port: int,
    token: Secret | None,
    dark: bool,
    progress: Callable[[float], None] | None = None,
    around: Surroundings = NOTHING_AROUND,
    link: str | None = None,
    stop: Stop | None = None,
) -> None:
    """Shows a vehicle until interrupted.

    Args:
        vehicle: with the rates that all is compared with.
        rates: to start with.
        conditions: to start with.
        host: address to listen on.
        port: to listen on.
        token: asked of every visitor, if any.
        dark: whether the page is dark.
        progress: told the fraction of the preparation that is done.
        around: the server.
        link: what new sessions show in place of rates and conditions, see `opening_of_link`.
        stop: ends it; if not given, only an exception in the main thread does.

    Raises:
        ModevizError: the port is in use, the address needs a token, the road does not go with the
            speed, or the link is none.
    """
    with one_thread(), ExitStack() as ending:
        bench = Bench(vehicle, rates, conditions, link)
        front = open_front(host, port, token, bench.title, around)
        directory = Directory(front, {vehicle.name: bench}, dark)
        ending.callback(directory.close)
        ending.callback(front.close)
        front.open(directory)
        print(f"{vehicle.name} is at {front.link}  (Ctrl+C ends)", flush=True)
        (stop or Stop()).wait(partial(_prepare, bench, progress))


def _prepare(bench: Bench, progress: Callable[[float], None] | None) -> None:
    """Makes a vehicle ready, and sees that there is an answer on the road of new sessions."""
    drive(bench.prepared(progress), bench.conditions)

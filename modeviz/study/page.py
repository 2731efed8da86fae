"""The page of a study: in a browser, or in a notebook's cell."""

import sys
import threading
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import partial
from html import escape
from typing import TYPE_CHECKING

from modeviz.analysis.results import Conditions
from modeviz.compute.threads import one_thread
from modeviz.study.telling import Tell
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from modeviz.viewer.app import App


@dataclass(frozen=True, eq=False)
class Page:
    """An open page. A notebook shows it in the cell; everywhere its link opens it in a browser.

    page = study.show()
    study.rates.use(page.rates)     # what was tuned there
    page.close()
    """

    link: str
    """What opens it, with its token: whoever has the link gets in."""
    height: int
    """In a notebook, pixels."""
    app: "App" = field(repr=False)
    """What is shown, as the viewer has it."""
    limit: ExitStack = field(repr=False)
    """Has BLAS on one thread as long as the page is open."""

    @property
    def rates(self) -> dict[str, MountRates]:
        """The mount rates that are on the page now, of every group, N/m."""
        return dict(self.app.session.state.design.rates)

    def wait(self) -> None:
        """Wait for Ctrl+C, then close it."""
        try:
            threading.Event().wait()
        except KeyboardInterrupt:
            pass
        finally:
            self.close()

    def close(self) -> None:
        """Close it; whoever has it open is told."""
        self.app.close()
        self.limit.close()

    def _repr_html_(self) -> str:
        link = escape(self.link, quote=True)
        return (
            f'<iframe title="modeviz" src="{link}" width="100%" height="{self.height}" '
            'style="border:0" allow="fullscreen"></iframe>'
            f'<div>Empty? <a href="{link}" target="_blank">Open it in a tab of its own</a>.</div>'
        )


def is_notebook() -> bool:
    """Return whether this runs in a notebook's kernel."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return hasattr(shell, "kernel")


def open_page(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    port: int,
    dark: bool,
    height: int,
    tell: Tell,
) -> Page:
    """Return a page that pages of this machine, such as a notebook, may show in a frame.

    Args:
        vehicle: with the rates that all is compared with.
        rates: to start with.
        conditions: to start with.
        port: to listen on, on this machine alone; 0 takes a free one.
        dark: whether the page is dark.
        height: in a notebook, pixels.
        tell: told how far the preparation is.

    Raises:
        ModevizError: the port is in use, or the road does not go with the speed.
    """
    from modeviz.viewer.app import App
    from modeviz.viewer.page.server import open_server
    from modeviz.viewer.page.tokens import new_token

    title = f"{vehicle.name} · modeviz"
    with ExitStack() as limit:
        limit.enter_context(one_thread())
        server = open_server(port=port, token=new_token(), title=title, is_framed=True)
        try:
            app = App(vehicle, rates, conditions, server, dark)
            app.start(partial(tell, "preparing"))
        except BaseException:
            server.stop()
            raise
        return Page(server.link, height, app, limit.pop_all())

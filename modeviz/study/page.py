"""The page of a study: in a browser, or in a notebook's cell."""

import os
import threading
from base64 import b64encode
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from modeviz.analysis.results import Conditions
from modeviz.compute.threads import one_thread
from modeviz.errors import ModevizError
from modeviz.report.images import png_bytes
from modeviz.study.cell import Cell
from modeviz.study.telling import Tell
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle

if TYPE_CHECKING:
    from modeviz.viewer.app import App
    from modeviz.viewer.session.answers import Solved


STILL = 960, 480
"""Pixels."""

N_COLORS = 128
"""Of the still, which are enough for flat shades."""

PATIENCE_S = 60.0
"""How long a cell waits for the first answer, to have a still."""

HUB_PREFIX = "JUPYTERHUB_SERVICE_PREFIX"
"""The environment variable by which a hub tells kernels where its notebook's server is."""


@dataclass(frozen=True)
class PageOptions:
    """How a page is opened, and shown in a cell."""

    port: int = 0
    """To listen on, on this machine alone; 0 takes a free one."""
    dark: bool = False
    """Whether it is dark."""
    height: int = 720
    """In a notebook, pixels."""
    through: str = ""
    """The address at which a notebook's browser reaches it, with "{port}"; "": the cell finds out."""
    offline: bool = True
    """Whether the cell keeps what plays without a server."""


@dataclass(frozen=True, eq=False)
class Page:
    """An open page. A notebook shows it in the cell; everywhere its link opens it in a browser.

    page = study.show()
    study.rates.use(page.rates)     # what was tuned there
    page.close()
    """

    link: str
    """What opens it, with its token: whoever has the link gets in."""
    options: PageOptions = field(repr=False)
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

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        cell = self._cell()
        bundle = {"text/plain": repr(self), "text/html": cell.html()}
        return bundle | ({"image/png": b64encode(cell.png).decode()} if cell.png else {})

    def _mime_(self) -> tuple[str, str]:
        """Return the same for marimo, which runs no scripts but in a frame."""
        return "text/html", self._cell().framed_html()

    def _newest(self) -> "Solved | None":
        """Return what is on the page, once what was asked for is; None if nothing ever was."""
        with suppress(ModevizError):
            return self.app.session.wait_for_answer(PATIENCE_S)
        return self.app.session.answer

    def _cell(self) -> Cell:
        """Return what a cell shows of the page as it is."""
        from modeviz.viewer.pictures.still import still
        from modeviz.viewer.scene.stage import ISO, box, camera

        session, options = self.app.session, self.options
        moving, png, page = "There is no answer yet.", b"", b""
        if solved := self._newest():
            moving = f"{solved.movement.heading}, at its largest"
            png = png_bytes(still(solved, options.dark, *STILL).quantize(N_COLORS))
            if options.offline:
                page = self.app.documents.offline(
                    *camera(box(session.vehicle), ISO, STILL[0], options.height)
                )
        return Cell(
            name=session.vehicle.name,
            link=self.link,
            through=options.through,
            prefix=os.environ.get(HUB_PREFIX, ""),
            height=options.height,
            moving=moving,
            png=png,
            page=page,
        )


def open_page(
    vehicle: Vehicle,
    rates: Rates,
    conditions: Conditions,
    options: PageOptions,
    tell: Tell,
) -> Page:
    """Return a page that a notebook may show in a frame.

    Args:
        vehicle: with the rates that all is compared with.
        rates: to start with.
        conditions: to start with.
        options: of the page.
        tell: told how far the preparation is.

    Raises:
        ModevizError: the port is in use, or the road does not go with the speed.
    """
    from modeviz.viewer.app import App
    from modeviz.viewer.page.doors.tokens import new_token
    from modeviz.viewer.page.server import open_server

    title = f"{vehicle.name} · modeviz"
    with ExitStack() as limit, ExitStack() as undoing:
        limit.enter_context(one_thread())
        server = open_server(port=options.port, token=new_token(), title=title, is_framed=True)
        undoing.callback(server.stop)
        app = App(vehicle, rates, conditions, server, options.dark)
        undoing.callback(app.end)
        app.start(partial(tell, "preparing"))
        undoing.pop_all()
        return Page(server.link, options, app, limit.pop_all())

"""What a study gives to look at: reports, pictures and the page."""

import warnings
from os import PathLike
from pathlib import Path

from modeviz.compute.threads import one_thread
from modeviz.export.solution import ExportOptions
from modeviz.files.disk import check_writable
from modeviz.files.rate_settings import ORIGINAL, resolve_rates
from modeviz.report.comparison import RateSet
from modeviz.study.exporting import export_files
from modeviz.study.notebooks import OpenPages, is_notebook, this_cell
from modeviz.study.page import Page, PageOptions, open_page
from modeviz.study.pictures import (
    Background,
    Colors,
    PictureOptions,
    View,
    WrittenFile,
    draw,
    image_settings,
    picture_kind,
    report_pictures,
)
from modeviz.study.reporting import write_report
from modeviz.study.telling import Tell
from modeviz.study.tuned_vehicle import TunedVehicle

OPEN = OpenPages()
"""In notebooks."""


class StudyOutput:
    """What a study writes and opens."""

    def __init__(self, tuned: TunedVehicle, tell: Tell) -> None:
        """Keeps what is drawn, and who is told how far a drawing is."""
        self._tuned, self._tell = tuned, tell
        self._page: Page | None = None

    @one_thread()
    def report(
        self,
        path: "str | PathLike[str]" = "report.html",
        against: str = ORIGINAL,
        *,
        road: str | None = None,
        pictures: bool = True,
    ) -> WrittenFile:
        """Write a comparison of the present rates with others as an HTML file that needs no network.

        Args:
            path: of the file.
            against: "original", the name of a set of the vehicle, or a JSON or CSV file.
            road: as of `ride`.
            pictures: whether it has some, for which a Chromium is needed.

        Raises:
            ModevizError: there is no such set or road, it cannot be written, or what draws is missing.
        """
        vehicle, rates = self._tuned.vehicle, self._tuned.rates
        base = RateSet(Path(against).name, resolve_rates(vehicle, against))
        now = RateSet(rates.name, rates.by_group)
        conditions = self._tuned.conditions(road)
        check_writable(Path(path))
        drawn = []
        if pictures and conditions is not None:
            drawn = report_pictures(vehicle, (base, now), conditions, self._tell)
        prepare = [self._tuned.prepared]
        write_report(Path(path), prepare, (base, now), conditions, drawn, self._tell)
        return WrittenFile(Path(path))

    @one_thread()
    def export(
        self,
        path: "str | PathLike[str]",
        *,
        road: str | None = None,
        below_hz: float | None = None,
        mode: str = "",
        units: str = "mm-t-s",
        first_id: int = 1,
    ) -> WrittenFile:
        """Write a file for other programs, with the present rates; what is left out is a warning.

        Args:
            path: of the file; its name ends in what it has, and says the format: "rates.bdf",
                "optimised-modes.unv", "psd.csv", "cab.vtu"; docs/export.md lists them.
            road: of responses, as of `ride`.
            below_hz: modes above are left out; None: those above the vehicle's band.
            mode: of a motion, its name; "": the lowest that vibrates.
            units: of Nastran cards, such as "mm-t-s"; all else is in SI.
            first_id: of the grids, elements, properties and coordinate systems in Nastran cards.

        Raises:
            ModevizError: there is no such content, format, road or unit, it cannot be solved, or the
                file cannot be written.
        """
        options = ExportOptions(below_hz=below_hz, mode=mode, units=units, first_id=first_id)
        export_files([Path(path)], self._tuned, road, options, warnings.warn)
        return WrittenFile(Path(path))

    @one_thread()
    def render(
        self,
        path: "str | PathLike[str]",
        mode: str = "",
        *,
        view: View = "Iso",
        color: Colors = "bodies",
        background: Background = "scene",
        dark: bool = False,
        width: int = 1280,
        height: int = 720,
        amplitude: float = 1.0,
        phase: float = 0.0,
        frames: int = 36,
    ) -> WrittenFile:
        """Write a picture of a mode: PNG, GIF, MP4, or HTML that still moves, as the ending says.

        Args:
            path: of the file.
            mode: its name; "": the one that the page opens with.
            view: from where it is seen.
            color: what the colours of bodies mean.
            background: as on the page, white or transparent.
            dark: whether the scene is dark.
            width: pixels.
            height: pixels.
            amplitude: of the motion, times the usual one.
            phase: of a PNG, degrees; 0 is the largest motion.
            frames: of a cycle in a GIF or MP4.

        Raises:
            ModevizError: there is no such mode, a number is out of its range, the file cannot be
                written, or what draws is missing.
        """
        options = PictureOptions(
            mode=mode,
            view=view,
            color=color,
            background=background,
            dark=dark,
            width=width,
            height=height,
            amplitude=amplitude,
            phase=phase,
            frames=frames,
        )
        picture_kind(Path(path))
        image_settings(options)
        check_writable(Path(path))
        vehicle, conditions = self._tuned.shown(None)
        draw(Path(path), options, vehicle, self._tuned.rates.by_group, conditions, self._tell)
        return WrittenFile(Path(path))

    def show(
        self,
        road: str | None = None,
        *,
        port: int = 0,
        dark: bool = False,
        height: int = 720,
        through: str = "",
        offline: bool = True,
    ) -> Page:
        """Open the page: in a notebook in the cell, elsewhere until Ctrl+C, printing its link.

        A notebook goes on at once, and a page that it showed before is closed. Only this machine can
        reach it, or who uses the notebook through a Jupyter server on it that has jupyter-server-proxy;
        others see a still of it. `modeviz view` has more to choose.

        Args:
            road: as of `ride`.
            port: to listen on; 0 takes a free one.
            dark: whether the page is dark.
            height: in a notebook, pixels.
            through: the address at which a notebook's browser reaches the page, with "{port}" in it,
                such as "https://code.example.com/proxy/{port}/"; "": the cell finds out.
            offline: whether the cell keeps what plays without a server, about a megabyte.

        Raises:
            ModevizError: the port is in use, or there is no such road.
        """
        if self._page is not None:
            self._page.close()
            self._page = None
        vehicle, conditions = self._tuned.shown(road)
        rates = self._tuned.rates.by_group
        options = PageOptions(port, dark, height, through, offline)
        page = open_page(vehicle, rates, conditions, options, self._tell)
        print(f"{vehicle.name} is at {page.link}", flush=True)
        if is_notebook():
            self._page = page
            OPEN.add(page, this_cell())
            page.limit.callback(OPEN.forget, page)
        else:
            page.wait()
        return page

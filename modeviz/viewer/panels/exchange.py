"""Left column: sets of rates as files, to and from the page's computer."""

from pathlib import PurePath
from typing import cast, get_args

import viser

from modeviz.errors import ModevizError, VehicleError
from modeviz.files.rate_files import RatesFormat, parse_rates, rates_text
from modeviz.text.wording import file_name
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.decisions import AddVariant
from modeviz.viewer.session.design import NamedSet, named_sets, variant_name
from modeviz.viewer.session.session import Session

FORMATS = {file_format.upper(): file_format for file_format in get_args(RatesFormat)}
LONGEST_NAME = 40


class ExchangePanel:
    """Buttons that save the present rates, and one that pins those of a file."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the buttons."""
        self._session = session
        save = gui.add_button_group(
            "Export",
            tuple(FORMATS),
            hint="Saves the present rates; modeviz reads the file with --rates",
        )
        save.on_click(lambda event: self._save(FORMATS[save.value], event))
        upload = gui.add_upload_button(
            "Import a set…",
            icon=viser.Icon.UPLOAD,
            mime_type=",".join(f".{file_format}" for file_format in FORMATS.values()),
            hint="Pins the rates of a CSV or JSON file under the file's name",
        )
        upload.on_upload(lambda event: self._read(upload.value, event))

    def _save(self, file_format: RatesFormat, event: viser.GuiEvent) -> None:
        if event.client is None:
            return
        state, vehicle = self._session.state, self._session.vehicle
        name = file_name(f"{vehicle.name} {variant_name(vehicle, state.design)}", file_format)
        content = rates_text(state.design.rates, file_format, vehicle).encode()
        event.client.send_file_download(name, content, save_immediately=True)

    def _read(self, file: viser.UploadedFile, event: viser.GuiEvent) -> None:
        if event.client is None:
            return
        try:
            rates = rates_in(file.name, file.content, self._session.vehicle)
        except ModevizError as error:
            event.client.add_notification("Not imported", f"{file.name}: {error}", color="red")
            return
        wanted = set_name(file.name)
        name = self._added(wanted, rates)
        other = "" if name == wanted else f"There is another set called {wanted}, so this is {name}. "
        event.client.add_notification("Imported", f"{other}Click {name} in the table to load it.")

    def _added(self, name: str, rates: Rates) -> str:
        """Pins rates under a name, or a like one if that is taken; gives the name that they have."""
        self._session.do(AddVariant(name, rates))
        vehicle, design = self._session.vehicle, self._session.state.design
        wanted = NamedSet(vehicle.all_rates(rates), design.alterations)
        named = (n for n, known in named_sets(vehicle, design).items() if known == wanted)
        return next((n for n in named if n.startswith(name)), name)


def rates_in(name: str, content: bytes, vehicle: Vehicle) -> Rates:
    """The rates in a file that somebody sent.

    Raises:
        VehicleError: it is none of rates, or not of this vehicle's.
    """
    ending = PurePath(name).suffix
    file_format = ending.lower().removeprefix(".")
    if file_format not in get_args(RatesFormat):
        raise VehicleError(f"found {ending!r}, expected a file of rates, .csv or .json")
    try:
        text = content.decode()
    except UnicodeDecodeError:
        raise VehicleError("not a text in UTF-8") from None
    rates = parse_rates(text, cast(RatesFormat, file_format), vehicle)
    if not rates:
        raise VehicleError("found no rates, expected those of one mount group or more")
    return rates


def set_name(file: str) -> str:
    """Return the name for the rates of a file: as the file, on one line and not too long."""
    return " ".join(PurePath(file).stem.split())[:LONGEST_NAME] or "Imported"

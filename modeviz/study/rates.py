"""The mount rates of a study: read, set and reset by their names."""

from collections.abc import Iterator
from dataclasses import replace
from os import PathLike, fspath
from pathlib import Path

from modeviz.errors import located
from modeviz.files.rate_files import write_rates
from modeviz.files.rate_settings import LOSS_FACTOR, ORIGINAL, parse_setting, rate_field, resolve_rates
from modeviz.report.rate_fields import listed_fields
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import table
from modeviz.study.displayed import Displayed
from modeviz.study.notebook import block, rate_rows, rates_table
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle


class StudyRates(Displayed):
    """The present mount rates, by names such as "C2.lateral" and "C2.loss_factor".

        study.rates["C2.lateral"] = "131 N/mm"    # or 131e3, N/m
        study.rates["C2.loss_factor"] = 0.2
        study.rates.use("optimised")              # a set of the vehicle, a file, or what was found
        study.rates.reset()

    Rates are read in SI: N/m, N m/rad about axes, N s/m of dampers, whether they are tuned or not;
    fore-aft is "fore_aft" or "fore-aft".
    """

    def __init__(self, vehicle: Vehicle) -> None:
        """Starts with the vehicle's own rates."""
        self._vehicle = vehicle
        self._rates = vehicle.all_rates({})
        self._used = ORIGINAL, self._rates

    def __getitem__(self, name: str) -> float:
        """Return a rate, SI, or a loss factor.

        Raises:
            VehicleError: there is no such group or direction, or its mounts each have their own rate.
        """
        name_of_group, field = self._place(name)
        group, rates = self._vehicle.mount_group(name_of_group), self._rates[name_of_group]
        if field == LOSS_FACTOR:
            return group.loss_factor_with(rates)
        with located(f"rates[{name!r}]"):
            return group.rate_of_each(field, rates)

    def __setitem__(self, name: str, value: float | str) -> None:
        """Set a rate to a number, SI, or to a text with its unit, "131 N/mm"; or a loss factor.

        Raises:
            VehicleError: there is no such group, direction or unit, or it is negative or not finite.
        """
        if isinstance(value, str):
            changed = parse_setting(f"{name}={value}", self._rates)
        else:
            group, field = self._place(name)
            with located(f"rates[{name!r}]"):
                changed = {group: replace(self._rates[group], **{field: float(value)})}
        self._rates = self._vehicle.all_rates({**self._rates, **changed})

    def __iter__(self) -> Iterator[str]:
        return iter(self.keys())

    def __len__(self) -> int:
        return len(self.keys())

    def __contains__(self, name: object) -> bool:
        return name in self.keys()

    def keys(self) -> tuple[str, ...]:
        """Return the names of all rates and loss factors."""
        groups = self._vehicle.mount_groups
        told = [(g.name, (*listed_fields(g, self._rates[g.name]), LOSS_FACTOR)) for g in groups]
        return tuple(f"{group}.{field}" for group, fields in told for field in fields)

    @property
    def by_group(self) -> dict[str, MountRates]:
        """The rates of every mount group, SI, as the functions of other folders take them."""
        return dict(self._rates)

    @property
    def name(self) -> str:
        """What the rates are called: that of a set of the vehicle, or what they were changed from."""
        for name in self.sets:
            if resolve_rates(self._vehicle, name) == self._rates:
                return name
        used, rates = self._used
        return used if rates == self._rates else f"{used}, changed"

    @property
    def sets(self) -> tuple[str, ...]:
        """The names of the vehicle's sets, its own first."""
        return ORIGINAL, *(name for name in self._vehicle.rate_sets if name != ORIGINAL)

    def use(self, choice: "str | PathLike[str] | Rates") -> None:
        """Take other rates.

        Args:
            choice: "original", the name of a set of the vehicle, a JSON or CSV file, or rates by their
                group, such as those of an `OptimiseResult`; groups that are left out get the vehicle's.

        Raises:
            VehicleError: there is no such set, file or group.
        """
        if isinstance(choice, str | PathLike):
            self._rates = resolve_rates(self._vehicle, fspath(choice))
            name = Path(choice).name
        else:
            self._rates, name = self._vehicle.all_rates(choice), "found"
        self._used = name, self._rates

    def reset(self) -> None:
        """Take the vehicle's own rates again."""
        self.use(ORIGINAL)

    def save(self, path: "str | PathLike[str]") -> Path:
        """Write the rates to a JSON or CSV file, which `use` reads; return its path.

        Raises:
            VehicleError: the name ends otherwise, or it cannot be written.
        """
        write_rates(Path(path), self._rates, self._vehicle)
        return Path(path)

    def table(self) -> str:
        """Return the rates, N/mm or as they say, beside the vehicle's own."""
        sets = list(self._compared.values())
        rows = [row for group in self._vehicle.mount_groups for row in rate_rows(group, sets)]
        return table(["rates, N/mm", *self._compared, ""], rows)

    def to_dict(self) -> Record:
        """Return plain values, see `report.records.rates_record`, by their group."""
        return rates_record(self._vehicle.with_rates(self._rates))

    def _repr_html_(self) -> str:
        rates = rates_table(self._vehicle, self._rates, self._compared)
        return block(f"Mount rates: {self.name}", rates)

    @property
    def _compared(self) -> dict[str, Rates]:
        return {ORIGINAL: self._vehicle.rates, "now": self._rates}

    def _place(self, name: str) -> tuple[str, str]:
        """The group and the field of a name; raises VehicleError for another."""
        with located(f"rates[{name!r}]"):
            return rate_field(name, self._rates)

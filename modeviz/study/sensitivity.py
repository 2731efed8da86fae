"""What each mount rate does to frequencies and to the ride."""

from dataclasses import dataclass
from html import escape

import numpy as np

from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.sensitivity import Sensitivity, rate_variables, sensitivity
from modeviz.report.rate_fields import is_damping
from modeviz.report.records import Record
from modeviz.report.tables import table as text_table
from modeviz.study.conditions import need
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, number_of, point_number
from modeviz.study.notebook import block, paragraphs
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.markup import table
from modeviz.text.wording import signed
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS

TENTH = 0.1
"""The part by which every rate rises."""


@dataclass(frozen=True, eq=False, repr=False)
class RateSensitivity(Displayed):
    """What ten percent more of each mount rate do, to first order, from analytic derivatives.

    sensitivity = study.sensitivity()
    sensitivity.of_mode("cab yaw")["C2.lateral"]                      # Hz
    sensitivity.of_rms("seat track left", "lateral")["C2.lateral"]    # a part of that RMS
    """

    results: Results
    """At whose rates, on whose road."""
    derivatives: Sensitivity
    """As `analysis.sensitivity` gives them: what +100 % would do."""

    @property
    def rates(self) -> tuple[str, ...]:
        """The names of the rates, as `study.rates` has them."""
        variables = rate_variables(self.results.prepared.vehicle)
        return tuple(f"{v.group}.{v.direction}" for v in variables)

    @property
    def modes(self) -> tuple[str, ...]:
        """The names of the modes."""
        return tuple(name.name for name in self.results.names)

    @property
    def frequency_hz(self) -> Floats:
        """(n_modes, n_rates): by how much natural frequencies rise, Hz."""
        return TENTH * self.derivatives.frequency_hz

    @property
    def damping_ratio(self) -> Floats:
        """(n_modes, n_rates): by how much dampers raise damping ratios; zero of stiffness."""
        return TENTH * self.derivatives.damping_ratio

    @property
    def rms(self) -> Floats:
        """(n_points, 3, n_rates): by which part of themselves RMS accelerations x, y, z rise."""
        return TENTH * self.derivatives.rms

    def of_mode(self, name: str) -> dict[str, float]:
        """Return by how much each rate raises a mode's frequency, Hz; VehicleError for no such mode."""
        return self._by_rate(self.frequency_hz[number_of("mode", name, self.modes)])

    def of_rms(self, point: str, direction: str) -> dict[str, float]:
        """Return by which part of itself each rate raises an RMS acceleration.

        Args:
            point: name of a response point.
            direction: "vertical", "lateral" or "fore-aft".

        Raises:
            VehicleError: there is no such point or direction.
        """
        number = point_number(self.results.vehicle, point)
        return self._by_rate(self.rms[number, axis_of(direction)])

    def table(self) -> str:
        """Return for each rate the mode it moves most, and what it does to the driver's RMS values."""
        return text_table(self._header, self._rows)

    def to_dict(self) -> Record:
        """Return plain values.

        `{"road", "rates": [...], "modes": [{"name", "frequency_hz": [...Hz for each rate],
        "damping_ratio": [...what dampers add]}], "rms": [{"point", "direction", "change": [...a part of
        the RMS value for each rate]}]}`, all for ten percent more of a rate.
        """
        points = self.results.vehicle.response_points
        return {
            "road": self.results.conditions.road,
            "rates": list(self.rates),
            "modes": [
                {"name": name, "frequency_hz": row.tolist(), "damping_ratio": damped.tolist()}
                for name, row, damped in zip(
                    self.modes, self.frequency_hz, self.damping_ratio, strict=True
                )
            ],
            "rms": [
                {"point": point.name, "direction": d, "change": self.rms[i, axis].tolist()}
                for i, point in enumerate(points)
                for d, axis in AXIS.items()
            ],
        }

    def _repr_html_(self) -> str:
        rows = [[escape(cell) for cell in row] for row in self._rows]
        about = f"{self.results.conditions.road}; to first order"
        header = [escape(cell) for cell in self._header]
        return block(
            "What ten percent more of a rate do", paragraphs(about), table(header, rows, words=(1,))
        )

    @property
    def _header(self) -> list[str]:
        driver = self.results.vehicle.response_points[0].name
        return ["+10 % of", "moves most", "Hz or ζ", *(f"{driver} {d} RMS" for d in RIDE_DIRECTIONS)]

    @property
    def _rows(self) -> list[list[str]]:
        rows = []
        for i, rate in enumerate(self.rates):
            is_damper = is_damping(rate.rpartition(".")[2])
            shifts = 100 * self.damping_ratio[:, i] if is_damper else self.frequency_hz[:, i]
            most = int(np.abs(shifts).argmax()) if len(shifts) else None
            moved = ["-", "-"]
            if most is not None:
                shift = signed(float(shifts[most]), 3)
                moved = [self.modes[most], f"ζ {shift} %" if is_damper else shift]
            changes = (float(self.rms[0, AXIS[d], i]) for d in RIDE_DIRECTIONS)
            rows.append([rate, *moved, *(signed(100 * change, 2, " %") for change in changes)])
        return rows

    def _by_rate(self, values: Floats) -> dict[str, float]:
        return dict(zip(self.rates, values.tolist(), strict=True))


def rate_sensitivity(tuned: TunedVehicle, road: str | None) -> RateSensitivity:
    """Return what ten percent more of each rate do; arguments and errors as of `Study.sensitivity`."""
    need(tuned.vehicle, "mount group", tuned.vehicle.mount_groups)
    results = tuned.ride(road)
    return RateSensitivity(results, sensitivity(tuned.prepared(), results))

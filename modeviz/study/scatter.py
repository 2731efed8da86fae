"""What mounts that are not as drawn do to a study's vehicle."""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.results import AXIS
from modeviz.report.charts import BASE, NOW, Curve, line_chart
from modeviz.report.optimum import objective_words, tolerance_words
from modeviz.report.records import Record
from modeviz.report.scatter import scatter_record, scatter_table
from modeviz.ride.psd import power_decibels
from modeviz.scatter.driving import Scattered
from modeviz.scatter.monte_carlo import Scatter
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, number_of
from modeviz.study.notebook import block, charts, figure, paragraphs
from modeviz.text.axes import Axis, decibel_axis, shown_hz
from modeviz.text.markup import table, title
from modeviz.text.wording import percent_change, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS


@dataclass(frozen=True, eq=False, repr=False)
class ScatterResult(Displayed):
    """What many vehicles do whose mounts are anywhere within their tolerance.

    scattered = study.scatter(10_000)
    np.percentile(scattered.rms("seat track left", "lateral"), 95)
    scattered.contributions["C2 left"]
    """

    told: Scattered
    """As the functions of `scatter` give it, with the worst corner and the shares of the spread."""

    @property
    def samples(self) -> Scatter:
        """The vehicles, as the functions of `scatter` give them."""
        return self.told.scatter

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the response points that were looked at."""
        return self.samples.points

    @property
    def goal(self) -> Floats:
        """(n_samples,): the objective of each vehicle."""
        return self.samples.goal

    @property
    def rating(self) -> Floats:
        """(n_samples,): the mean personal rating of each vehicle at the first point."""
        return self.samples.mean_personal_rating

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): where PSDs are kept."""
        return self.samples.frequency_hz

    @property
    def worst_goal(self) -> float:
        """The objective at the worst corner of the tolerances."""
        return self.told.worst.goal

    @property
    def contributions(self) -> dict[str, tuple[float, float]]:
        """By mount, which parts of the objective's variance its hardness and its loss factor make.

        Sobol's first-order indices; empty where there were too few samples to tell.
        """
        if self.told.spread is None:
            return {}
        hardness, loss = np.split(self.told.spread.shares, 2)
        pairs = zip(self.samples.parts.names, hardness.tolist(), loss.tolist(), strict=True)
        return {name: (k, g) for name, k, g in pairs}

    def __len__(self) -> int:
        return len(self.goal)

    def rms(self, point: str, direction: str) -> Floats:
        """Return the RMS acceleration of each vehicle, (n_samples,), g.

        Args:
            point: name of a response point that was looked at.
            direction: "vertical", "lateral" or "fore-aft".

        Raises:
            VehicleError: there is no such point or direction.
        """
        return self.samples.rms[:, self._point(point), axis_of(direction)]

    def psd_percentile(self, percent: float, point: str, direction: str) -> Floats:
        """Return a percentile of the vehicles' PSDs at each frequency, (n_freqs,), g²/Hz.

        Args:
            percent: of which percentile, 0 to 100.
            point: as of `rms`, as is the direction.
            direction: likewise.

        Raises:
            VehicleError: as `rms`.
        """
        bands = self.samples.psd_percentiles([percent])
        return bands[0, :, self._point(point), axis_of(direction)]

    def table(self) -> str:
        """Return percentiles of ride and objective, the worst corner, and what makes the spread."""
        return scatter_table(self.told)

    def to_dict(self) -> Record:
        """Return what `modeviz scatter --json` prints, see `report.scatter.scatter_record`."""
        return scatter_record(self.told)

    def _repr_html_(self) -> str:
        record = self.to_dict()
        keys = ("nominal", "mean", "p5", "p50", "p95")
        rows = [
            [
                title(name.replace("_", " ").replace("rms", "RMS")),
                *(f"{values[key]:.4g}" for key in keys),
            ]
            for name, values in record["quantities"].items()
        ]
        header = [title(self.points[0]), "As drawn", "Mean", "5 %", "50 %", "95 %"]
        tolerance = tolerance_words(self.samples.parts.tolerance)
        worse = percent_change(self.worst_goal, self.samples.nominal_goal)
        return block(
            f"{len(self)} vehicles on {self.told.conditions.road}",
            paragraphs(
                tolerance,
                f"Goal: {objective_words(self.told.problem)}; at the worst corner of the tolerances "
                f"{significant(self.worst_goal)}, {worse}",
            ),
            table(header, rows),
            self._shares_table(),
            charts(self._band(direction) for direction in RIDE_DIRECTIONS),
        )

    def _shares_table(self) -> str:
        """Return which mounts make the spread, those that make most first."""
        shares = sorted(self.contributions.items(), key=lambda pair: -sum(pair[1]))
        rows = [[title(name), *(f"{100 * share:.1f} %" for share in pair)] for name, pair in shares]
        return table(["Of the goal's spread", "Hardness", "Loss factor"], rows) if rows else ""

    def _band(self, direction: str) -> str:
        """The spectra at the first point, from the 5th to the 95th percentile."""
        bands = self.samples.psd_percentiles((5, 50, 95))[:, :, 0, AXIS[direction]]
        low, middle, high = (power_decibels(np.asarray(band, float)) for band in bands)
        f = self.frequency_hz
        curves = [
            Curve("5 and 95 %", f, low, BASE, 1.2),
            Curve("", f, high, BASE, 1.2),
            Curve("median", f, middle, NOW),
        ]
        shown = shown_hz(float(f[-1]))
        inside = [c.y[(f >= shown[0]) & (f <= shown[1])] for c in curves]
        caption = f"{direction.capitalize()} acceleration at {self.points[0]}"
        svg = line_chart(
            curves,
            Axis("Frequency, Hz", *shown),
            decibel_axis("dB re 1 g²/Hz", inside),
            caption,
            440,
            210,
        )
        return figure(svg, caption)

    def _point(self, name: str) -> int:
        return number_of("response point", name, self.points)

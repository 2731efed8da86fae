"""How a study's vehicle sags and what its mounts carry under loads that stay."""

from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from modeviz.mounting.statics import Carried, StaticCase, Statics
from modeviz.mounting.travel import Travel, travels
from modeviz.report.records import Record
from modeviz.report.statics import (
    carried_cells,
    motion_cells,
    mounts_of,
    others_of,
    statics_record,
    statics_table,
    travel_cells,
)
from modeviz.study.displayed import Displayed
from modeviz.study.notebook import block, paragraphs
from modeviz.text.markup import table
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True, eq=False, repr=False)
class StaticResults(Displayed):
    """A vehicle in its load cases, which iterate and are found by their names.

    static = study.static()
    static["standing"].bodies["engine"]             # x, y, z, rx, ry, rz, m and rad
    static["standing"].connections["M1"].force      # on the engine, along the mount's axes, N and N m
    """

    results: Statics
    """As the functions of `mounting` take it."""

    def __len__(self) -> int:
        return len(self.results.cases)

    def __iter__(self) -> Iterator[StaticCase]:
        return iter(self.results.cases)

    def __getitem__(self, name: str) -> StaticCase:
        """Return a load case by its name; raises as `Statics.case`."""
        return self.results.case(name)

    def sag(self, body: str, case: str = "standing") -> Floats:
        """Return x, y, z, rx, ry, rz of a body's centre of gravity, (6,), m and rad.

        Args:
            body: its name.
            case: name of a load case.

        Raises:
            VehicleError: there is no such body or case.
            SolveError: the case has no answer.
        """
        self.results.vehicle.body(body)
        return self[case].bodies[body]

    def travel(self, case: str) -> tuple[Travel, ...]:
        """Return the travel of every mount that has limits in a load case; raises as `sag`."""
        return tuple(travels(self.results, self[case]))

    def table(self) -> str:
        """Return motions, forces, deflections and travel, case by case."""
        return statics_table(self.results)

    def to_dict(self) -> Record:
        """Return what `modeviz static --json` prints, see `report.statics.statics_record`."""
        return statics_record(self.results)

    def _repr_html_(self) -> str:
        refused = [escape(f"{r.name}: no answer, {r.reason}") for r in self.results.refused]
        cases = [part for case in self for part in self._case_html(case)]
        return block(f"{self.results.vehicle.name} in its load cases", *cases, paragraphs(*refused))

    def _case_html(self, case: StaticCase) -> Iterator[str]:
        header = [escape(case.name), "x, mm", "y, mm", "z, mm", "rx, °", "ry, °", "rz, °"]
        yield table(header, [[escape(n), *motion_cells(m)] for n, m in case.bodies.items()])
        yield paragraphs(*case.notes)
        for what, every in (("Mount", mounts_of(case)), ("Other connection", others_of(case))):
            if every:
                yield _carried_html(what, every)
        if limited := list(travels(self.results, case)):
            rows = [[escape(f"{t.mount} {t.direction}"), *travel_cells(t)] for t in limited]
            yield table(["Travel", "mm", "From", "To", "Margin, mm", ""], rows)


def _carried_html(what: str, every: list[Carried]) -> str:
    header = [what, "x, N", "y, N", "z, N", "x, mm", "y, mm", "z, mm"]
    return table(header, [[escape(c.connection.name), *carried_cells(c)] for c in every])

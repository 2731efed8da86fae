"""The tables of a vehicle file from which what is wrong is taken out, as little of each as can be.

A key that may be left out goes alone; one that has to be there takes its table with it, unless
something can stand in for it. What referred to it by name goes when the rest is put together.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from modeviz.errors import Fault
from modeviz.files.own_tables import BODIES, MOUNTS
from modeviz.files.records.vehicle import CONNECTION_KINDS, TUNED_KINDS, VehicleRecord
from modeviz.files.schema.hints import is_record, joined
from modeviz.files.schema.mismatches import faults_of
from modeviz.files.schema.walking import each_table, place_of, required_keys, type_at
from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND

STAND_INS: Mapping[str, float] = {"damping_ratio": 0.0, "loss_factor": 0.0}
"""What keys are taken to be that have to be there, so that a body or a mount is read without them."""

TABLES: Mapping[str, tuple[str, ...]] = {
    "body": ("flexible_body", "rigid_body"),
    "connection": (*CONNECTION_KINDS, "mount_group", "absorber"),
    "mount group": ("mount_group", "spring_group", "damper_group", "absorber"),
    "spring group": ("spring_group",),
    "damper group": ("damper_group",),
    "added mass": ("added_mass",),
    "absorber": ("absorber",),
    "response point": ("response_point",),
    "random load": ("road", "force", "base_motion"),
    "harmonic load": ("wheel_load", "force", "base_motion"),
    "wheel load": ("wheel_load",),
    "force": ("force",),
    "base motion": ("base_motion",),
    "problem": ("problem",),
    "load case": ("load_case",),
}
"""The keys of the tables in which a part of a vehicle stands, by its kind."""

SUPPLIES: Mapping[str, str] = {"dynamic": "loss_factor"}
"""Tables of a mount group, each with a key that has to be there once it is taken out."""

REFERENCES = frozenset(
    ("body", "bodies", "tyre", "connections", "roads", "wheel_loads", "points", "reference", "group")
)
"""Keys with names of other tables; "group" only where it is no connection's."""

BAND = ("highest_frequency", "frequency_step")
"""Keys of the file that only fit each other."""

Step = tuple[Any, Any, Any]
"""A table with a key of it, or a list with an item of it; and the type of that table or list."""


class Draft:
    """The tables of a vehicle file, which get fewer."""

    def __init__(
        self,
        tables: dict[str, Any],
        table_bodies: Sequence[str] = (),
        table_mounts: Sequence[str] = (),
    ) -> None:
        self.tables: dict[str, Any] = tables
        """What is left; those given are changed."""
        self._table_bodies: Sequence[str] = table_bodies
        """The bodies in the file that the key `BODIES` names."""
        self._table_mounts: Sequence[str] = table_mounts
        """The mounts and their groups in the one that `MOUNTS` names."""
        self._taken: set[tuple[int, str]] = set()
        self._paths: dict[int, str] = {id(table): path for path, table in each_table(tables)}
        self._lost: set[str] = set()
        self._lost_bodies: set[str] = set()
        self._had_engines: bool = bool(tables.get("engine"))
        self._was_grounded: bool = MOUNTS in tables or self._is_grounded()

    @property
    def stand_ins(self) -> tuple[RigidBody, ...]:
        """Bodies for those that were taken out, so that what holds on to them can be checked."""
        return tuple(
            RigidBody(name, "other", name, 1.0, np.zeros(3), np.eye(3))
            for name in sorted(self._lost_bodies - self._names() - {GROUND})
        )

    def without(self, faults: Iterable[Fault]) -> list[tuple[Fault, str]]:
        """Return faults by the file's own keys, each with the key of what is now taken out for it.

        That is empty where nothing can be taken out. Others are among them that are in the same tables,
        which may not be looked at again.

        Args:
            faults: found in the tables as they are.
        """
        faults = [other for fault in faults for other in self._in_same_table(fault)]
        steps = [self._steps(fault.path) for fault in faults]
        named = [
            replace(fault, path=self._own(s, fault)) for fault, s in zip(faults, steps, strict=True)
        ]
        return [(fault, self._take_out(s)) for fault, s in zip(named, steps, strict=True)]

    def _in_same_table(self, fault: Fault) -> list[Fault]:
        """The fault and all others of keys of its table, if it is one of a key's type."""
        where, table, record = "", self.tables, VehicleRecord
        inner = ""
        for container, key, hint in self._steps(fault.path):
            if isinstance(container, dict) and is_record(hint):
                where, table, record = inner, container, hint
            inner = (
                f"{inner}[{place_of(container, key)}]"
                if isinstance(container, list)
                else joined(inner, key)
            )
        faults = list(faults_of(table, record, where))
        return faults if fault in faults else [fault]

    def path_of(self, kind: str, name: str) -> str:
        """Return the key of the last table of that name of a kind of parts; empty if there is none."""
        if kind == "mode damping of":
            return "mode_damping"
        if kind not in TABLES:
            return joined(kind, name)
        found = [
            path
            for key in TABLES[kind]
            for path, table in each_table(self.tables.get(key, []), key)
            if table.get("name") == name
        ]
        return found[-1] if found else ""

    def drop_bodies(self) -> None:
        """Take out what holds on to bodies that were taken out, which have no stand-ins from now on."""
        self._lost |= self._lost_bodies
        self._lost_bodies.clear()
        self.drop_orphans()

    def drop_orphans(self) -> bool:
        """Take out what names something that was taken out; return whether there was anything.

        Bodies do not count, for which there are stand-ins.
        """
        found = False
        while True:
            orphans = [self._steps(path) for path in self._orphans()]
            taken = [self._take_out(steps) for steps in orphans]
            if not any(taken):
                return found
            found = True

    def _orphans(self) -> Iterator[str]:
        """Keys of tables that name something lost; of a problem's tables, that of the problem."""
        lost = self._lost - self._names()
        if MOUNTS in self.tables and BODIES not in self.tables and lost & {*self._table_bodies}:
            yield MOUNTS
        if self._was_grounded and not (MOUNTS in self.tables or self._is_grounded()):
            motions = each_table(self.tables.get("base_motion", []), "base_motion")
            yield from (path for path, _ in motions)
        if self._had_engines and not self.tables.get("engine"):
            problems = each_table(self.tables.get("problem", []), "problem")
            yield from (path for path, table in problems if table.get("goal") == "idle")
        for path, table in each_table(self.tables):
            if not lost.isdisjoint(_references(table)):
                yield re.sub(r"^(problem\[\d+\]).*", r"\1", path)
            if path.startswith("rates."):
                yield from (joined(path, key) for key in table if key in lost)

    def drop_empty_groups(self) -> bool:
        """Take out groups whose springs or dampers were taken out; return whether there were any."""
        taken = [self._take_out(self._steps(path)) for path in self._empty_groups()]
        return any(taken)

    def _empty_groups(self) -> list[str]:
        in_table = {*self._table_mounts} if MOUNTS in self.tables else set[str]()
        return [
            path
            for kind in TUNED_KINDS
            for path, table in each_table(self.tables.get(f"{kind}_group", []), f"{kind}_group")
            if table.get("name") in self._lost - in_table - self._groups_of(kind)
        ]

    def _groups_of(self, kind: str) -> set[str]:
        """The groups of what is left of springs or dampers."""
        return {str(table.get("group", f"{kind}s")) for table in self.tables.get(kind, [])}

    def _is_grounded(self) -> bool:
        """Whether something that is left holds on to the ground."""
        return any(GROUND in table.get("bodies", ()) for _, table in each_table(self.tables))

    def _names(self) -> set[str]:
        """The names of all that is left."""
        return {str(table["name"]) for _, table in each_table(self.tables) if "name" in table}

    def _own(self, steps: list[Step], fault: Fault) -> str:
        """The path of a fault in the file, where its tables may have had other numbers."""
        path, after = "", fault.path
        now = ""
        for container, key, _ in steps:
            if isinstance(container, list):
                now += f"[{place_of(container, key)}]"
                path = self._paths.get(id(key), now)
            else:
                now, path = joined(now, key), joined(self._paths[id(container)], key)
            after = fault.path[len(now) :]
        return path + after

    def _steps(self, path: str) -> list[Step]:
        """The way to what a path names, as far as there is one."""
        at, hint, where, steps = self.tables, VehicleRecord, "", []
        while where != path and isinstance(at, dict | list):
            items = at.items() if isinstance(at, dict) else enumerate(at)
            ways = [(joined(where, key), key, value) for key, value in items]
            ways = [
                way for way in ways if path == way[0] or path.startswith((f"{way[0]}.", f"{way[0]}["))
            ]
            if not ways:
                if isinstance(at, dict):
                    steps.append((at, path[len(where) :].lstrip("."), hint))
                break
            where, key, value = max(ways, key=lambda way: len(way[0]))
            steps.append((at, key if isinstance(at, dict) else value, hint))
            at, hint = value, type_at(hint, key)
        return steps

    def _take_out(self, steps: list[Step]) -> str:
        """Take out the least that a way leads to; return its key, or none if it is the whole."""
        item = ""
        for container, key, hint in reversed(steps):
            if isinstance(container, list):
                if isinstance(key, dict):
                    item = self._paths[id(key)]
                    if all(other is not key for other in container):
                        return item  # for another fault
                    self._lose(key)
                    container[:] = [other for other in container if other is not key]
                    if container:
                        return item
            elif (stand_in := self._stand_in(container, key)) is not None:
                container[key] = stand_in
                return joined(self._paths[id(container)], key)
            elif (id(container), key) in self._taken:
                return joined(self._paths[id(container)], key)  # for another fault
            elif key in container and key not in required_keys(hint):
                for each in BAND if key in BAND else (key,):
                    self._lose(container.pop(each, None))
                    self._taken.add((id(container), each))
                    if each in SUPPLIES:
                        container.setdefault(SUPPLIES[each], STAND_INS[SUPPLIES[each]])
                if container is self.tables and key == BODIES:
                    self._lost_bodies |= {*self._table_bodies}
                if container is self.tables and key == MOUNTS:
                    self._lost |= {*self._table_mounts}
                return item or joined(self._paths[id(container)], key)
            else:
                item = ""
        return ""

    def _stand_in(self, table: dict[str, Any], key: str) -> Any:
        """What a key can be, as if the file said so; None if it can be nothing, or is that already."""
        if table is self.tables:
            known: Mapping[str, Any] = {"name": "vehicle"}
        elif table is self.tables.get("units"):
            known = {**WRITTEN_UNITS}
        else:
            known = {"name": self._paths[id(table)], **STAND_INS}
        return known[key] if key in known and table.get(key) != known[key] else None

    def _lose(self, value: Any) -> None:
        for _, table in each_table(value):
            path = self._paths[id(table)]
            is_body = path.startswith(TABLES["body"])
            if (kind := path.partition("[")[0]) in TUNED_KINDS:
                self._lost.add(str(table.get("group", f"{kind}s")))
            if "name" in table:
                (self._lost_bodies if is_body else self._lost).add(str(table["name"]))


def _references(table: Mapping[str, Any]) -> Iterator[str]:
    """The names of other tables in a table."""
    for key in REFERENCES & table.keys():
        if key != "group" or "bodies" not in table:
            names = table[key] if isinstance(table[key], list) else [table[key]]
            yield from (name for name in names if isinstance(name, str))

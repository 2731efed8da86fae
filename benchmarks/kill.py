"""`python -m benchmarks.kill`: a study that is written while its process is killed, a thousand times.

Each time a process opens the study, goes on where its session was, and is killed by SIGKILL at a random
moment: while it opens the file, between writes, in one, or while it ends. What it had been told to be
saved must be there, in the order in which it was done, and of what it had not been told nothing but a
part from its beginning; the history of undoing must be the one that these changes leave. Now and then
the file is a new one, or one of the first version, whose tables are brought up to date on the way.
Needs `os.fork`.
"""

import argparse
import os
import random
import select
import signal
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from modeviz.journal.changes import LONGEST, Change, Kind, Step
from modeviz.journal.fingerprint import Fingerprint
from modeviz.journal.opening import open_to_write
from modeviz.journal.records import Records
from modeviz.journal.schema import APPLICATION_ID, STEPS
from modeviz.journal.sessions import StoredSession
from modeviz.journal.study_file import StudyFile
from modeviz.journal.tuning import Tuning
from modeviz.report.notes import Note
from modeviz.vehicle.mount_rates import MountRates

TITLE = "A study that is written while its process is killed."

SESSION = StudyFile.session_id("the session that is killed")
VEHICLE = Fingerprint({"name": "killed"})
LONGEST_S = 0.12
"""In which a process is killed at the latest; it has written hundreds of changes by then."""

PATIENCE_S = 60.0
ROUNDS_OF_A_FILE = 50
STATE_BYTES = 3000
"""About what a state of the pickup takes."""


@dataclass(frozen=True)
class Model:
    """What a session should be like."""

    state: str = "0"
    past: tuple[Step, ...] = ()
    future: tuple[Step, ...] = ()
    n_notes: int = 0
    n_done: int = 0

    def after(self, act: "Act") -> "Model":
        """Return it after one more act."""
        more = {"n_done": self.n_done + 1}
        past, future = self.past, self.future
        match act.kind:
            case "look":
                return Model(act.state, past, future, self.n_notes, **more)
            case "note":
                return Model(self.state, past, future, self.n_notes + 1, **more)
            case "undo":
                (*past, step), future = past, (*future, past[-1])
                return Model(step.before, tuple(past), future, self.n_notes, **more)
            case "redo":
                (*future, step), past = future, (*past, future[-1])
                return Model(step.after, past, tuple(future), self.n_notes, **more)
            case "longer":
                past = (*past[:-1], Step(past[-1].before, act.state))
            case _:
                past = (*past, Step(self.state, act.state))
        return Model(act.state, past, (), self.n_notes, **more)


@dataclass(frozen=True)
class Act:
    """Something that is done in a session."""

    kind: str
    state: str


def acts(model: Model, seed: int) -> Iterator[tuple[Act, Model]]:
    """Yield what is done from there on, and what it leads to: the same for the same seed."""
    chance = random.Random(seed)
    before = ""
    while True:
        kinds = ["step", "step", "look", "note"]
        kinds += ["undo"] * bool(model.past) + ["redo"] * bool(model.future)
        kinds += ["longer"] * 3 * (before in ("step", "longer"))
        before = chance.choice(kinds)
        act = Act(before, f"{model.n_done + 1} {chance.randbytes(STATE_BYTES // 2).hex()}")
        model = model.after(act)
        yield act, model


def do(study: StudyFile, act: Act, before: Model, after: Model) -> None:
    """Does it."""
    match act.kind:
        case "look":
            study.look(SESSION, act.state)
        case "note":
            study.put_note(SESSION, Note(f"note {after.n_notes}"))
        case kind:
            step = before.past[-1] if kind == "undo" else after.past[-1]
            study.record(SESSION, _change(kind, step, after.n_done))


def _change(kind: str, step: Step, number: int) -> Change:
    kinds: dict[str, Kind] = {"step": "step", "longer": "longer", "undo": "undo", "redo": "redo"}
    rates = {"C2": MountRates(float(number), 1.0, 1.0)}
    return Change(kinds[kind], f"act {number}", step.before, step.after, tuning=Tuning(rates))


def work(path: Path, model: Model, seed: int, pipe: int) -> None:
    """Goes on with a session until killed; tells of each act before it is asked for, and once saved."""
    chance = random.Random(seed)
    study = StudyFile.open(path, "killed", VEHICLE)
    study.begin(SESSION)
    study.flush(60)
    for act, after in acts(model, seed):
        os.write(pipe, b"a")
        do(study, act, model, after)
        model = after
        if chance.random() < 0.5 and study.flush(60):
            os.write(pipe, b"s")
        if chance.random() < 0.003:
            break
    study.close(60)
    os.write(pipe, b"s")


@dataclass
class Killed:
    """What came of it."""

    n_kills: int = 0
    n_saved: int = 0
    """Acts of which a process had been told that they are saved."""
    n_asked: int = 0
    in_flight: list[int] = field(default_factory=list)
    """Acts that were asked for and not told to be saved, of each kill."""
    lost: list[int] = field(default_factory=list)
    """Of these, those that are not there."""
    n_unopened: int = 0
    """Kills before the file was open."""

    def __str__(self) -> str:
        return (
            f"{self.n_kills} kills, {self.n_unopened} of them before the study was open: "
            f"{self.n_saved} acts told to be saved, all there and in order; "
            f"of {self.n_asked - self.n_saved} not told so {sum(self.lost)} are lost "
            f"(at most {max(self.lost, default=0)} of {max(self.in_flight, default=0)} at a time, "
            f"in {sum(map(bool, self.lost))} kills)"
        )


def kill_often(
    folder: Path, n_kills: int, seed: int = 0, rounds_of_a_file: int = ROUNDS_OF_A_FILE
) -> Killed:
    """Return what came of killing so often.

    Raises:
        AssertionError: a study could not be read, or lacked what was saved.
    """
    chance, killed = random.Random(seed), Killed()
    model = Model()
    for i in range(n_kills):
        path = folder / f"study-{i // rounds_of_a_file}.modeviz"
        if i % rounds_of_a_file == 0:
            model = Model()
            if i // rounds_of_a_file % 2:
                write_first_version(path)
        is_open = chance.random() < 0.6
        told = _run_and_kill(path, model, seed + i, chance.uniform(0, LONGEST_S), is_open)
        model = _check(path, model, seed + i, told, killed)
    return killed


def write_first_version(path: Path) -> None:
    """Writes a study as the first version of the tables had it, with nothing in it yet."""
    connection = open_to_write(path)
    connection.executescript(f"{STEPS[0]} PRAGMA application_id = {APPLICATION_ID};")
    connection.execute("INSERT INTO study VALUES (?, ?, 0)", ("killed", time.time()))
    connection.execute("PRAGMA user_version = 1")
    connection.close()


def _run_and_kill(path: Path, model: Model, seed: int, after: float, is_open: bool) -> bytes:
    """Returns what a process told before it was killed, some s after it began or opened the study."""
    reads, writes = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reads)
            work(path, model, seed, writes)
        finally:
            os._exit(0)
    os.close(writes)
    if is_open:
        select.select([reads], [], [], PATIENCE_S)
    time.sleep(after)
    os.kill(child, signal.SIGKILL)
    os.waitpid(child, 0)
    told = b""
    while select.select([reads], [], [], 5)[0] and (more := os.read(reads, 65536)):
        told += more
    os.close(reads)
    return told


def _check(path: Path, model: Model, seed: int, told: bytes, killed: Killed) -> Model:
    """Checks what is there after a kill, and returns it."""
    n_asked, n_saved = told.count(b"a"), told[: told.rfind(b"s") + 1].count(b"a")
    killed.n_kills += 1
    killed.n_asked += n_asked
    killed.n_saved += n_saved
    killed.n_unopened += not n_asked
    found = _found(path)
    expected = [model, *(after for _, after in islice(acts(model, seed), n_asked))]
    possible = [k for k in range(n_saved, n_asked + 1) if _is(found, expected[k])]
    assert possible, (
        f"{path.name}: after {n_saved} saved of {n_asked} acts the study is {_brief(found)}, expected "
        f"one of {[_brief(each) for each in expected[n_saved:]]}"
    )
    killed.in_flight.append(n_asked - n_saved)
    killed.lost.append(n_asked - possible[-1])
    return expected[possible[-1]]


def _found(path: Path) -> tuple[StoredSession | None, int]:
    """The session as it is read by whoever opens the study next, and how many notes it has."""
    if not path.exists():
        return None, 0
    study = StudyFile.open(path, "killed", VEHICLE)
    try:
        assert Records.of_file(path).study().vehicle_name == "killed"
        return study.restore(SESSION), len(study.notes(SESSION))
    finally:
        study.close()


def _brief(found: tuple[StoredSession | None, int] | Model) -> str:
    """What there is, with states by the numbers with which they begin."""
    session, n_notes = (found, found.n_notes) if isinstance(found, Model) else found
    if session is None:
        return f"no session and {n_notes} notes"
    stacks = (
        ", ".join(f"{step.before.split()[0]} to {step.after.split()[0]}" for step in steps)
        for steps in (session.past, session.future)
    )
    state = (session.state or "none").split()[0]
    return "state {}, past {}, future {}, {} notes".format(state, *stacks, n_notes)


def _is(found: tuple[StoredSession | None, int], model: Model) -> bool:
    session, n_notes = found
    if session is None or session.state is None:
        return (n_notes, model.past, model.future, model.state) == (model.n_notes, (), (), "0")
    return (session.state, session.past, session.future, n_notes) == (
        model.state,
        model.past[-LONGEST:],
        model.future[-LONGEST:],
        model.n_notes,
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Kills as often as is asked for, and prints what came of it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.kill", description=TITLE)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args(arguments)
    with tempfile.TemporaryDirectory() as folder:
        begin = time.perf_counter()
        print(kill_often(Path(folder), given.kills, given.seed))
        sizes = [path.stat().st_size for path in Path(folder).glob("*.modeviz")]
    took = time.perf_counter() - begin
    print(f"{took:.0f} s; the largest of {len(sizes)} files has {max(sizes) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()

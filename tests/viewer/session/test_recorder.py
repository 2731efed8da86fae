"""A session in a study file: as it was after a restart, with all that can be undone."""

import os
import random
import subprocess
import sys
import threading
from dataclasses import replace
from pathlib import Path

import pytest
from every_command import ABSORBERS, DECISIONS, LOOKS, ON_THE_WAY, VEHICLE
from session_commands import Listener

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.journal import changes
from modeviz.journal.fingerprint import Fingerprint, fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.author import Author, NotOnesOwnError
from modeviz.viewer.session.commands import decisions, looks
from modeviz.viewer.session.encoding.plain import plain_of
from modeviz.viewer.session.encoding.text import text_of
from modeviz.viewer.session.recorded import recorded
from modeviz.viewer.session.recorder import Recorder
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state
from modeviz.viewer.session.view import Animation, CameraPose, PageView

FIRST = first_state(VEHICLE, VEHICLE.rates, Conditions("flat", 20.0))
PRINT = fingerprint_of(VEHICLE)
KEY = StudyFile.session_id("a key")
SOON = 20.0
ADA, BEA = Author("Ada"), Author("Bea", "digest of her key")


class Bench:
    """A session that is recorded, and can be restarted."""

    def __init__(self, path):
        self.path, self.mistakes, self.acting = path, [], ADA
        self.open()

    def open(self, vehicle=VEHICLE):
        self.study = StudyFile.open(self.path, vehicle.name, fingerprint_of(vehicle))
        usual = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
        self.opening = recorded(self.study, KEY, usual, vehicle, fingerprint_of(vehicle).digest)
        state = self.opening.state if self.opening else usual
        past, future = (self.opening.past, self.opening.future) if self.opening else ((), ())
        self.session = Session(
            vehicle, state, Listener(), past=past, future=future, acting=lambda: self.acting
        )
        self.recorder = Recorder(
            self.session, self.study, KEY, lambda: self.acting, self.mistakes.append
        )

    def close(self):
        assert self.recorder.close(SOON)
        self.session.close()
        assert self.study.close(SOON)
        assert not self.mistakes

    def restart(self, vehicle=VEHICLE):
        self.close()
        self.open(vehicle)

    @property
    def moment(self):
        """All that a session is: state, past and future, with fields that do not count otherwise."""
        moment = self.session._asked.moment
        steps = (*moment.past, *moment.future)
        changes = [(plain_of(step.before), plain_of(step.after)) for step in steps]
        return plain_of(moment.state), changes, len(moment.past)

    def history(self):
        self.recorder.flush(SOON)
        return [entry for entry in self.study.history(KEY) if entry.kind in ("step", "undo", "redo")]


@pytest.fixture
def bench(tmp_path):
    bench = Bench(tmp_path / "study.modeviz")
    yield bench
    bench.close()


def test_every_command_is_there_after_a_restart_and_all_of_it_can_be_undone(bench):
    for command in (*DECISIONS, *LOOKS, *ON_THE_WAY, *ABSORBERS):
        bench.session.do(command)
    everything = bench.session.state.design
    bench.session.undo()
    bench.session.undo()
    before = bench.moment
    bench.restart()
    assert bench.moment == before
    assert bench.opening.remarks == ()
    bench.session.redo()
    while bench.session.can_undo:
        bench.session.undo()
    assert bench.session.state.design == FIRST.design
    bench.restart()
    while bench.session.can_redo:
        bench.session.redo()
    assert bench.session.state.design == everything


@pytest.mark.parametrize("seed", range(6))
def test_whatever_is_done_and_undone_a_restart_is_not_noticed(bench, seed):
    rng = random.Random(seed)
    commands = [*DECISIONS, *LOOKS, *ON_THE_WAY]
    for _ in range(4):
        for _ in range(rng.randrange(1, 15)):
            what = rng.random()
            if what < 0.2:
                bench.session.undo()
            elif what < 0.35:
                bench.session.redo()
            elif what < 0.5:
                bench.session.do(decisions.SetRate("A", "lateral", float(rng.randrange(1, 9) * 10**5)))
            else:
                bench.session.do(rng.choice(commands))
        before = bench.moment
        bench.restart()
        assert bench.moment == before


def test_a_drag_is_one_step_that_ends_where_the_hand_left_it(bench):
    for i in range(1, 200):
        bench.session.do(decisions.SetRate("B", "lateral", 1e5 + i))
    entries = bench.history()
    assert [entry.title for entry in entries] == ["Set B.lateral"]
    (difference,) = entries[0].differences
    assert (difference.what, difference.before, difference.after) == (
        "B.lateral", "300 N/mm", "100.2 N/mm",
    )  # fmt: skip
    bench.restart()
    assert bench.session.state.design.rates["B"].lateral == 1e5 + 199
    bench.session.undo()
    assert bench.session.state.design == FIRST.design


def test_a_drag_that_goes_all_the_way_back_leaves_no_step(bench):
    for rate in (1e5, 2e5, VEHICLE.rates["B"].lateral):
        bench.session.do(decisions.SetRate("B", "lateral", rate))
    bench.restart()
    assert not bench.session.can_undo
    assert bench.session.state.design == FIRST.design


def test_of_looks_the_last_counts_and_none_is_a_change(bench):
    for f in range(1, 20):
        bench.session.do(looks.ChangeCharts(cursor_hz=float(f)))
    bench.session.do(looks.ShowMode("cab roll"))
    assert not bench.history()
    bench.restart()
    assert bench.session.state.charts.cursor_hz == 19.0
    assert bench.session.state.motion.mode == "cab roll"
    assert not bench.session.can_undo


def test_of_how_pages_show_it_the_last_counts(bench):
    bench.restart()
    assert (bench.opening.animation, bench.opening.camera) == (Animation(), None)
    standing = Animation(1.85, 0.75, 215.0, False)
    for x in range(1, 30):
        bench.recorder.see(PageView(standing, CameraPose((x, 0.0, 1.0), (0.0, 0.0, 0.0))))
        bench.session.do(looks.ChangeCharts(cursor_hz=1.0 + x / 10))
        assert len(bench.recorder._waiting) <= 2
    bench.restart()
    assert bench.opening.animation == standing
    assert bench.opening.camera == CameraPose((29.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    bench.study.see(KEY, "no view")
    bench.restart()
    assert bench.opening.camera is None


def test_each_change_says_who_made_it(bench):
    bench.session.do(decisions.SetRate("A", "lateral", 1e5))
    bench.acting = BEA
    bench.session.do(decisions.Pin("Hers"))
    bench.session.undo()
    told = [(entry.author, entry.kind, entry.title, entry.is_undone) for entry in bench.history()]
    assert told == [
        ("Ada", "step", "Set A.lateral", False),
        ("Bea", "step", "Pin Hers", True),
        ("Bea", "undo", "Undo: Pin Hers", False),
    ]


def test_whose_a_step_is_is_known_after_a_restart(bench):
    bench.session.do(decisions.SetRate("A", "lateral", 1e5))
    bench.acting = BEA
    bench.session.do(decisions.Pin("Hers"))
    bench.session.do(decisions.SetRate("A", "lateral", 2e5))
    bench.session.undo()
    bench.acting = ADA
    bench.session.undo(insists=True)
    bench.restart()
    with pytest.raises(NotOnesOwnError, match="Bea's"):
        bench.session.redo()
    bench.acting = Author("Beatrice", BEA.id)
    bench.session.redo()
    bench.session.redo()
    bench.session.undo()
    bench.session.undo()
    with pytest.raises(NotOnesOwnError, match="Ada's"):
        bench.session.undo()
    assert bench.history()[-1].author == "Beatrice"


def test_what_a_failed_solve_took_back_is_not_there_after_a_restart(bench):
    """As `Session` goes back to the last state that was solved where modeviz itself fails."""
    session = bench.session
    session.do(decisions.SetRate("A", "lateral", 1e5))
    good = session._asked.moment
    for command in (decisions.SetRate("A", "lateral", 2e5), decisions.Pin("v"), looks.SelectGroup("A")):
        session.do(command)
    assert session._asked.take_back(session.state, good)
    before = bench.moment
    bench.restart()
    assert bench.moment == before
    assert session.state.design.rates["A"].lateral == 1e5


def test_what_can_be_redone_is_the_same_after_a_restart_when_a_change_was_taken_back(bench):
    session = bench.session
    for name in ("X", "A"):
        session.do(decisions.Pin(name))
    session.undo()
    good = session._asked.moment
    session.do(decisions.Pin("B"))
    assert session._asked.take_back(session.state, good)
    session.redo()
    session.undo()
    before = bench.moment
    bench.restart()
    assert bench.moment == before
    bench.session.redo()
    assert [*bench.session.state.design.variants] == ["X", "A"]
    bench.session.undo()
    bench.session.undo()
    assert not bench.session.state.design.variants


def test_what_was_undone_since_the_moment_gone_back_to_cannot_be_redone_after_a_restart(bench):
    bench.session.do(decisions.Pin("X"))
    good = bench.session._asked.moment
    bench.session.do(decisions.Pin("B"))
    bench.session.undo()
    assert bench.session._asked.take_back(bench.session.state, good)
    assert not bench.session.can_redo
    before = bench.moment
    bench.restart()
    assert bench.moment == before


@pytest.mark.parametrize("seed", range(6))
def test_whatever_is_taken_back_a_restart_is_not_noticed(bench, seed):
    rng = random.Random(seed)
    moments = [bench.session._asked.moment]
    for number in range(80):
        what = rng.random()
        if what < 0.35:
            bench.session.do(decisions.Pin(f"v{number}"))
        elif what < 0.6:
            bench.session.undo()
        elif what < 0.75:
            bench.session.redo()
        else:
            bench.session._asked.take_back(bench.session.state, rng.choice(moments[-6:]))
        moments.append(bench.session._asked.moment)
        if number % 20 == 19:
            before = bench.moment
            bench.restart()
            assert bench.moment == before
            moments = [bench.session._asked.moment]


class SlowStudy:
    """A study whose disk does not answer until it is let go."""

    def __init__(self):
        self.free, self.written = threading.Event(), []

    def begin(self, name, author):
        pass

    def look(self, name, state):
        pass

    def record(self, name, change):
        self.free.wait()
        self.written.append(change)

    def flush(self, timeout):
        return True


def test_no_hand_waits_for_the_disk_and_nothing_is_lost_by_it():
    session, study = Session(VEHICLE, FIRST, Listener()), SlowStudy()
    recorder = Recorder(session, study, KEY, lambda: ADA, pytest.fail)
    for i in range(50):
        session.do(decisions.SetRate("A", "lateral", 1e5 + i))
        session.do(decisions.SetRate("B", "lateral", 1e5 + i))
    assert not study.written
    assert not recorder.flush(0.05)
    study.free.set()
    assert recorder.close(SOON)
    session.close()
    assert len(study.written) == 100
    assert "100049" in study.written[-1].after


def test_what_cannot_be_written_is_a_mistake_that_is_told_and_the_next_is_written():
    session, study, told = Session(VEHICLE, FIRST, Listener()), SlowStudy(), []
    study.free.set()
    study.look = lambda name, state: None
    recorder = Recorder(session, study, KEY, lambda: ADA, told.append)
    session.do(decisions.Pin("\ud800"))  # half a letter, which no page sends
    session.do(decisions.Pin("whole"))
    session.do(decisions.Forget("\ud800"))
    assert recorder.close(SOON)
    session.close()
    assert {type(error) for error in told} == {UnicodeEncodeError}


def stiffer(vehicle):
    """The vehicle with other bounds of A, and without B."""
    group = vehicle.mount_group("A")
    bounds = replace(group.bounds[0], lateral=2.5e5), group.bounds[1]
    return replace(vehicle, mount_groups=(replace(group, bounds=bounds),))


def test_of_a_vehicle_that_has_changed_what_fits_is_kept_and_the_rest_is_said(bench):
    for command in (
        decisions.SetRate("A", "lateral", 2e5),
        decisions.SetRate("B", "lateral", 1e5),
        decisions.Pin("Mine"),
        looks.ChangeLook(coloring="strain energy"),
    ):
        bench.session.do(command)
    bench.restart(stiffer(VEHICLE))
    told, state = bench.opening.remarks, bench.session.state
    assert told[0] == (
        "vehicle 'cabin' has changed since this session was left: mount group A, no mount group B"
    )
    assert any("mount group 'B'" in remark for remark in told)
    assert any("A lateral rate: found 200000, which is outside its bounds" in r for r in told)
    assert {*state.design.rates} == {*state.design.variants["Mine"].rates} == {"A"}
    assert state.design.rates["A"].lateral == 2e5
    assert state.look.coloring == "strain energy"
    while bench.session.can_undo:
        bench.session.undo()
    assert bench.session.state.design.rates["A"] == VEHICLE.rates["A"]
    bench.restart(stiffer(VEHICLE))
    assert bench.opening.remarks == ()


def test_a_session_that_was_not_there_opens_as_usual(tmp_path):
    study = StudyFile.open(tmp_path / "new.modeviz", "cabin", PRINT)
    assert recorded(study, KEY, FIRST, VEHICLE, PRINT.digest) is None
    study.close()


def test_a_state_of_a_later_modeviz_is_refused(tmp_path):
    study = StudyFile.open(tmp_path / "late.modeviz", "cabin", Fingerprint({}))
    study.begin(KEY)
    study.look(KEY, '{"version": 99, "content": {}}')
    with pytest.raises(ModevizError, match="later modeviz"):
        recorded(study, KEY, FIRST, VEHICLE, PRINT.digest)
    study.close()


def test_a_step_that_cannot_be_read_is_not_gone_over_and_what_is_shown_stays(bench):
    for rate in (1e5, 2e5):
        bench.session.do(decisions.SetRate("A", "lateral", rate))
        bench.session.do(looks.SelectGroup("A"))
        bench.session.do(decisions.Pin(f"{rate:g}"))
    good = bench.session.state
    bench.recorder.flush(SOON)
    bench.study.record(
        KEY, changes.Change("step", "Later", '{"version": 99, "content": {}}', text_of(good))
    )
    bench.restart()
    for _ in range(2):
        with pytest.raises(ModevizError, match="later modeviz"):
            bench.session.undo()
    assert bench.session.state == good
    assert bench.session.can_undo
    bench.session.do(decisions.SetRate("B", "lateral", 1e5))
    bench.session.undo()
    assert bench.session.state.design == good.design


CHILD = """
import sys
from pathlib import Path
from test_recorder import Bench
from modeviz.viewer.session.commands import decisions

bench = Bench(Path(sys.argv[1]))
for i in range(1, 10_000):
    bench.session.do(decisions.Pin(f"v{i}"))
    bench.session.do(decisions.SetRate("A", "lateral", 1e5 + i))
    bench.session.do(decisions.SetRate("B", "lateral", 1e5 + i))
    bench.recorder.flush()
    print(i, flush=True)
"""


def test_a_session_whose_process_is_killed_is_where_it_was(tmp_path):
    """At most what was being done in that moment is lost, and all before can be undone."""
    path, here = tmp_path / "killed.modeviz", Path(__file__).parent
    folders = os.pathsep.join(map(str, (here, here.parents[1], here.parents[2])))
    command = [sys.executable, "-c", CHILD, str(path)]
    environment = {**os.environ, "PYTHONPATH": folders}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as run:
        told = 0
        while told < 5:
            told = int(run.stdout.readline())
        run.kill()
        told = int((run.stdout.read().split() or [told])[-1])
    bench = Bench(path)
    rates = bench.session.state.design.rates
    reached = round(rates["A"].lateral - 1e5)
    assert told <= reached <= told + 1
    assert 1e5 + told <= rates["B"].lateral <= rates["A"].lateral
    n_undone = 0
    while bench.session.can_undo:
        bench.session.undo()
        n_undone += 1
    assert 3 * told <= n_undone <= 3 * (told + 1)
    assert bench.session.state.design == FIRST.design
    bench.close()


TITLES = {
    "Set A.lateral": decisions.SetRate("A", "lateral", 1e5),
    "Set A": decisions.TakeRates({"A": MountRates(1e5, 2e5, 3e5)}),
    "Set A, B": decisions.TakeRates({g: MountRates(1e5, 2e5, 3e5) for g in "AB"}),
    "Set A.loss-factor": decisions.SetLossFactor("A", 0.3),
    "Place B": decisions.PlaceMounts("B", "angles", (None, None, 0.1)),
    "Lock A.lateral": decisions.ToggleLock("A", "lateral"),
    "Keep ratios of A": decisions.LinkRates("A", True),
    "Pin Mine": decisions.Pin("Mine"),
    "Change targets": decisions.ChangeTargets({"gap": 3.0}),
    "Change what a search is to find": decisions.ChangePlan(lambda _, p: replace(p, n_starts=3)),
    "Add absorber roof": ABSORBERS[0],
}


@pytest.mark.parametrize(("title", "command"), TITLES.items(), ids=TITLES)
def test_a_change_is_told_in_words(bench, title, command):
    bench.session.do(command)
    assert [entry.title for entry in bench.history()] == [title]
    assert bench.history()[0].differences

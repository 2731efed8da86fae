"""A search in a session that moves mounts too: what the session makes of it."""

from dataclasses import replace

import pytest
from cabin_session import SOON, Watcher, open_session
from session_commands import AlterPlan

from modeviz.files.problem_file import problem_text, read_problem
from modeviz.optimise.goals import prepare_goal
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.alterations import altered
from modeviz.vehicle.placement import Placement
from modeviz.viewer.panels.optimise.places import ranged
from modeviz.viewer.session.commands.absorbers import AddAbsorber
from modeviz.viewer.session.commands.decisions import PlaceMounts
from modeviz.viewer.session.planning.plan import planned
from modeviz.viewer.tasks.search_task import SearchTask


@pytest.fixture
def session():
    """One with a search that may move the mounts of A."""
    with open_session() as (session, _):
        plan = ranged(session.state.design.plan, "offset", 2, (-20.0, 30.0))
        plan = replace(plan, goal="accelerations", n_starts=1)
        session.do(AlterPlan(groups=plan.groups, goal=plan.goal, n_starts=1))
        yield session


@pytest.fixture
def optimiser(session):
    watcher = Watcher()
    optimiser = SearchTask(session, watcher.tell, print)
    optimiser.wait = watcher.wait
    yield optimiser
    optimiser.close()


def found_by(optimiser):
    optimiser.start()
    optimiser.wait(lambda: not optimiser.job.is_running)
    assert optimiser.job.found, optimiser.job.failure
    return optimiser.job.found


def worth(session):
    """The goal of what the session has, solved anew."""
    original, design = session.original, session.state.design
    given = altered(original, design.alterations.placed({}))
    rates = given.all_rates(design.rates)
    goal = prepare_goal(given, planned(given, design.plan), rates, 20.0)
    return goal.of_vehicle(altered(original, design.alterations)).exact_value(design.rates)


def test_mounts_are_where_the_search_found_them_and_go_back(session, optimiser):
    session.do(AddAbsorber(Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)))
    plan = session.state.design.plan.with_group(free=frozenset())
    session.do(AlterPlan(groups=plan.groups, free=frozenset({"A"})))
    session.do(PlaceMounts("B", "offset", (0.01, None, None)))
    session.do(PlaceMounts("roof", "offset", (0.1, None, None)))
    session.wait_for_answer(SOON)
    before = session.state.design
    found = found_by(optimiser)
    design = session.state.design
    assert design.alterations.placements == found.placements
    assert found.placements["B"] == Placement((0.01, 0.0, 0.0))
    assert found.placements["roof"] == Placement((0.1, 0.0, 0.0))
    assert abs(found.placements["A"].offset[2]) > 1e-4
    assert worth(session) == pytest.approx(found.value, rel=1e-6)
    optimiser.accept()
    assert session.state.design.variants["Optimised 1"].placements == found.placements
    optimiser.go_back()
    assert session.state.design.alterations == before.alterations
    session.undo()
    session.undo()
    assert session.state.design.alterations == before.alterations
    assert session.state.design.rates == before.rates


def test_a_saved_problem_has_the_places(session, tmp_path):
    problem = planned(session.original, session.state.design.plan)
    (tmp_path / "p.toml").write_text(problem_text(problem))
    read = read_problem(tmp_path / "p.toml", session.original)
    group = next(group for group in read.groups if group.group == "A")
    assert group.offsets["z"] == pytest.approx((-0.02, 0.03))

"""What answers show in a notebook: whole HTML, with names that do no harm."""

from dataclasses import replace

import pytest
from html_documents import Document
from studied_cabin import cabin_study

from modeviz.study.study import Study
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.vehicle import Vehicle

BAD = "<b>&</b>"
"""A name that is shown as it is."""

ASKED = {
    "study": lambda study: study,
    "rates": lambda study: study.rates,
    "modes": lambda study: study.modes(),
    "ride": lambda study: study.ride(),
    "wheels": lambda study: study.wheels(),
    "forces": lambda study: study.forces(),
    "paths": lambda study: study.paths(),
    "sensitivity": lambda study: study.sensitivity(),
    "optimise": lambda study: study.optimise(starts=1, budget=9),
    "front": lambda study: study.front("lateral against vertical", starts=1, budget=60),
    "scatter": lambda study: study.scatter(80),
}
CHARTS = {"ride": 2, "wheels": 2, "optimise": 1, "front": 1, "scatter": 2}


@pytest.mark.parametrize("name", ASKED)
def test_answers_are_whole_html_with_their_charts(name):
    html = ASKED[name](cabin_study())._repr_html_()
    document = Document(f"<h1>cell</h1>{html}")
    assert html.count("<svg xmlns") == CHARTS.get(name, 0)
    assert document.addresses == []
    assert "script" not in document.tags
    assert ".modeviz" in html  # its style is of what is inside alone


def named_badly(vehicle: Vehicle) -> Vehicle:
    """The same vehicle with names that are HTML."""
    first, *others = vehicle.mount_groups
    mounts = tuple(replace(mount, name=f"{BAD} {mount.name}") for mount in first.mounts)
    group: MountGroup = replace(first, name=BAD, mounts=mounts)
    (point,) = vehicle.response_points
    road, *roads = vehicle.roads
    (load,) = vehicle.wheel_loads
    return replace(
        vehicle,
        name=BAD,
        mount_groups=(group, *others),
        response_points=(replace(point, name=BAD),),
        roads=(replace(road, name=BAD), *roads),
        wheel_loads=(replace(load, name=BAD),),
        problems=(),
        rate_sets={BAD: {}},
        notes=(BAD,),
    )


@pytest.mark.parametrize("name", ASKED)
def test_names_are_no_html(name):
    study = Study(named_badly(cabin_study().vehicle))
    assert BAD not in ASKED[name](study)._repr_html_()

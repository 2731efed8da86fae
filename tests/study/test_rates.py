"""The mount rates of a study: read, set and reset by their names."""

from dataclasses import replace

import numpy as np
import pytest
from studied_cabin import cabin_study
from tuned_vehicle import tuned_vehicle

import modeviz as mv
from modeviz.errors import VehicleError
from modeviz.vehicle.mount_rates import MountRates


def test_a_text_with_its_unit_and_a_number_in_si_set_the_same_rate():
    first, second = cabin_study().rates, cabin_study().rates
    first["A.lateral"], second["A.lateral"] = "131 N/mm", 131e3
    assert first["A.lateral"] == second["A.lateral"] == pytest.approx(131e3)
    first["B.fore-aft"] = "100 kN/mm"
    assert first["B.fore_aft"] == pytest.approx(1e8)
    assert first.by_group["B"].fore_aft == first["B.fore-aft"]


def test_a_loss_factor_is_the_groups_until_it_is_set():
    rates = cabin_study().rates
    assert rates["A.loss_factor"] == 0.15
    rates["A.loss_factor"] = 0.3
    rates["B.loss_factor"] = "0.25"
    assert (rates["A.loss_factor"], rates["B.loss_factor"]) == (0.3, 0.25)
    assert "A loss factor" in rates.table()


def test_rates_are_named_and_become_a_dictionary():
    rates = cabin_study().rates
    assert dict(rates)["A.vertical"] == 8e5
    assert len(rates) == len(list(rates)) == 8
    assert "B.fore_aft" in rates


@pytest.mark.parametrize(
    ("name", "value", "sentence"),
    [
        ("C.lateral", "1 N/mm", "unknown mount group 'C': there are A, B"),
        ("C.lateral", 1e3, "unknown mount group 'C': there are A, B"),
        ("A.latral", 1e3, "unknown direction 'latral': did you mean 'lateral'?"),
        ("A.lateral", "131 N/mn", "unknown unit of stiffness 'N/mn': did you mean 'N/m'? "),
        ("A.lateral", "131", "found '131' without a unit, expected one of N/m, "),
        ("A.lateral", -1.0, "lateral rate: found -1.0 N/m, expected zero or more"),
        ("A.lateral", "-1 N/mm", "lateral rate: found -1000.0 N/m, expected zero or more"),
        ("A.lateral", float("nan"), "lateral rate: found nan N/m"),
        ("A", 1e3, "expected GROUP.DIRECTION or GROUP.loss_factor, as in C2.lateral"),
        ("A.loss_factor", "0.2 N/mm", "expected a number without a unit"),
    ],
)
def test_what_is_no_rate_is_refused_and_changes_nothing(name, value, sentence):
    rates = cabin_study().rates
    before = rates.by_group
    with pytest.raises(VehicleError) as refused:
        rates[name] = value
    assert sentence in str(refused.value)
    assert "\n" not in str(refused.value)
    assert rates.by_group == before


def test_reading_an_unknown_rate_says_which_there_are():
    with pytest.raises(VehicleError, match="unknown mount group 'Z': there are A, B"):
        cabin_study().rates["Z.lateral"]


def test_sets_files_and_what_was_found_are_used_and_reset(tmp_path):
    rates = cabin_study().rates
    assert rates.sets == ("original", "soft")
    rates.use("soft")
    assert (rates.name, rates["A.vertical"]) == ("soft", 2e5)
    rates["A.vertical"] = 3e5
    assert rates.name == "soft, changed"
    file = rates.save(tmp_path / "mine.json")
    rates.reset()
    assert (rates.name, rates["A.vertical"]) == ("original", 8e5)
    rates.use(file)
    assert (rates.name, rates["A.vertical"]) == ("mine.json", 3e5)
    rates.use({"B": MountRates(1e5, 1e5, 1e5)})
    assert (rates["A.vertical"], rates["B.lateral"]) == (8e5, 1e5)
    with pytest.raises(VehicleError, match=r"unknown rates 'stiff'.*there are original, soft"):
        rates.use("stiff")


def test_rates_that_are_not_tuned_are_read_as_the_mounts_have_them():
    study = mv.Study(tuned_vehicle())
    assert study.rates["F.damping-lateral"] == 120
    assert study.rates["F.damping-fore-aft"] == 500
    assert study.rates["F.rx"] == 200
    assert study.rates["S.rx"] == 0
    feet = study.vehicle.mount_group("F")
    own = replace(feet.mounts[0], damping=np.array([0.0, 7.0, 0.0]))
    mixed = replace(feet, mounts=(own, *feet.mounts[1:]))
    groups = tuple(mixed if g is feet else g for g in study.vehicle.mount_groups)
    others = mv.Study(replace(study.vehicle, mount_groups=groups))
    with pytest.raises(mv.ModevizError, match="mounts of 'F' each have their own, from 7 to 120 N s/m"):
        others.rates["F.damping-lateral"]

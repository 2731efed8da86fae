import pytest
from mounted_cabin import mounted_cabin

from modeviz.errors import VehicleError
from modeviz.files.rate_files import rates_text
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.panels.exchange import rates_in, set_name

RATES = {"A": MountRates(4e5, 131.4e3, 4e5)}


@pytest.mark.parametrize("name", ["set.csv", "SET.JSON"])
def test_a_file_gives_the_rates_that_were_written(name):
    text = rates_text(RATES, "csv" if name.endswith("csv") else "json")
    assert rates_in(name, text.encode(), mounted_cabin()) == RATES


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        ("set.txt", b"", "found '.txt', expected a file of rates, .csv or .json"),
        ("set", b"", "found '', expected a file of rates"),
        ("set.csv", b"\xff", "not a text in UTF-8"),
        ("set.csv", b"", "expected the columns group, vertical, lateral, fore_aft"),
        ("set.json", b'{"rates": {}}', "found no rates"),
        ("set.csv", b"group,units,vertical,lateral,fore_aft\nZ,N/mm,1,1,1\n", "'Z'"),
    ],
)
def test_a_wrong_file_is_refused_with_what_is_wrong(name, content, complaint):
    with pytest.raises(VehicleError) as error:
        rates_in(name, content, mounted_cabin())
    assert complaint in str(error.value)


def test_a_set_is_called_as_its_file():
    assert set_name("My  softer set.csv") == "My softer set"
    assert len(set_name("x" * 100 + ".csv")) == 40

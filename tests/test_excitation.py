from types import SimpleNamespace

from modeviz.viewer.panels.excitation import _road_labels


def test_roads_of_one_label_are_told_apart_by_their_names():
    roads = [
        SimpleNamespace(name="road 1", label="Country"),
        SimpleNamespace(name="road 2", label="Country"),
        SimpleNamespace(name="road 3", label="Town"),
    ]
    assert _road_labels(roads) == {
        "Country (road 1)": "road 1",
        "Country (road 2)": "road 2",
        "Town": "road 3",
    }

import json
import signal
from collections import Counter
from pathlib import Path

import pytest
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.files import write_vehicle

BROWSER = Path(__file__).parent / "browser"

LONG = {"builtin_truck", "prepared_truck", "truck_modes", "subprocess"}
"""What a module of tests has imported when its tests take seconds rather than milliseconds."""

HALF_A_MINUTE = {
    "test_app",
    "test_connecting",
    "test_doors",
    "test_mounts",
    "test_notebook_page",
    "test_optimise_page",
    "test_pictures",
    "test_state_link_page",
    "test_staying_up",
}
"""Files of browser tests that take so long, however few tests are in them."""


def pytest_configure():
    """Ctrl+C works as on a terminal, also where tests run behind a script that has it ignored."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_collection_modifyitems(items):
    """Puts quick tests first, so that a failure shows soon, and those that drive a browser last.

    Of these long files come first: the last ones end at about the same time on every processor.
    """
    n_tests = Counter(item.path for item in items)
    of_browser = {path for path in n_tests if BROWSER in path.parents}

    def rank(item):
        if item.path in of_browser:
            return True, item.path.stem not in HALF_A_MINUTE, -n_tests[item.path]
        is_long = not LONG.isdisjoint(vars(item.module))
        return False, is_long

    items.sort(key=rank)


@pytest.fixture(scope="session", autouse=True)
def state_folder(tmp_path_factory):
    """What commands keep for the user stays out of the home of who runs the tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    """The small cabin's folder, to be read only."""
    path = tmp_path_factory.mktemp("vehicles") / "cabin"
    write_vehicle(mounted_cabin(), path)
    return str(path)


@pytest.fixture
def printed_json(capsys):
    """What a command prints with --json, read."""

    def printed_json(*arguments):
        capsys.readouterr()
        assert main([*arguments, "--json"]) == 0
        return json.loads(capsys.readouterr().out)

    return printed_json

import json

import pytest
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.files import write_vehicle


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

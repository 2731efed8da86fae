import pytest
from studied_cabin import cabin_study

from modeviz.files import write_vehicle


@pytest.fixture(scope="package")
def cabin_folder(tmp_path_factory):
    """The cabin of the studies as a folder, for the command line."""
    path = tmp_path_factory.mktemp("vehicles") / "cabin"
    write_vehicle(cabin_study().vehicle, path)
    return str(path)

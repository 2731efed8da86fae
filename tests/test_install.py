"""What a person installs: complete, and at home in any folder."""

import json
import os
import subprocess
import sys
import tarfile
from pathlib import Path
from zipfile import ZipFile

import pytest

pytestmark = pytest.mark.slow

CHECKOUT = Path(__file__).parents[1]
PACKAGE = CHECKOUT / "modeviz"
TRUCK = CHECKOUT / "assets" / "truck"


def run(*command: str | Path, folder: Path = CHECKOUT, **environment: str) -> str:
    """What a command prints, having ended well."""
    done = subprocess.run(
        [str(word) for word in command],
        cwd=folder,
        env=os.environ | environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def build_wheel(source: Path, folder: Path) -> Path:
    options = ("--no-deps", "--no-build-isolation", "--quiet", "--wheel-dir", folder)
    run(sys.executable, "-m", "pip", "wheel", *options, source)
    return next(folder.glob("*.whl"))


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return build_wheel(CHECKOUT, tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def sdist(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sdist")
    run(sys.executable, "-m", "hatchling", "build", "--target", "sdist", "--directory", folder)
    return next(folder.glob("*.tar.gz"))


@pytest.fixture(scope="module")
def site(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with modeviz installed and nothing else, far from the checkout."""
    folder = tmp_path_factory.mktemp("site")
    options = ("--no-deps", "--no-compile", "--quiet", "--target", folder)
    run(sys.executable, "-m", "pip", "install", *options, wheel)
    return folder


def contents(folder: Path, place: str) -> dict[str, bytes]:
    """The files of a folder of the checkout by their names at a place inside the wheel."""
    files = (p for p in folder.rglob("*") if p.is_file() and "__pycache__" not in p.parts)
    return {f"{place}/{p.relative_to(folder).as_posix()}": p.read_bytes() for p in files}


def test_wheel_holds_the_package_and_the_truck_and_nothing_else(wheel: Path):
    with ZipFile(wheel) as archive:
        held = {name: archive.read(name) for name in archive.namelist() if ".dist-info/" not in name}
    assert "modeviz/assets/truck/vehicle.toml" in held
    assert held == contents(PACKAGE, "modeviz") | contents(TRUCK, "modeviz/assets/truck")


def test_sdist_holds_tests_builder_and_licence(sdist: Path):
    with tarfile.open(sdist) as archive:
        names = {name.split("/", 1)[1] for name in archive.getnames()}
    wanted = {"LICENSE", "assets/build_truck.py", "assets/truck/vehicle.toml", "tests/test_install.py"}
    assert wanted <= names


def test_wheel_out_of_the_sdist_is_the_same(sdist: Path, wheel: Path, tmp_path: Path):
    assert build_wheel(sdist, tmp_path).read_bytes() == wheel.read_bytes()


def test_installed_package_finds_the_truck_it_came_with(site: Path, tmp_path: Path):
    program = "from modeviz.files import builtin_vehicle; print(builtin_vehicle())"
    found = run(sys.executable, "-c", program, folder=tmp_path, PYTHONPATH=str(site))
    assert Path(found.strip()).is_relative_to(site)


def test_installed_command_solves_the_truck_from_any_folder(site: Path, tmp_path: Path):
    command = site / "bin" / "modeviz"
    answer = run(command, "modes", "--json", folder=tmp_path, PYTHONPATH=str(site))
    assert "cab yaw" in {mode["name"] for mode in json.loads(answer)["modes"]}

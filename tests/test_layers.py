"""Who may import whom: a folder knows only what stands before it."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[1]
PACKAGE = CHECKOUT / "modeviz"

LAYERS = [
    {"errors"},
    {"units"},
    {"vehicle"},
    {"fem", "formats"},
    {"dynamics"},
    {"ride"},
    {"tuning"},
    {"shapes"},
    {"export"},
    {"public"},
    {"__init__"},
    {"viewer"},
    {"commands"},
    {"cli"},
    {"__main__"},
]
NARROWER = {"shapes": {"errors", "units", "vehicle", "dynamics"}}

MODULES = sorted(PACKAGE.rglob("*.py"))
MACHINE_PATH = re.compile(r"/(?:home|opt|private|root|tmp|Users|usr|work)/|\b[A-Z]:\\")


def layer_of(path: Path) -> str:
    """The folder of modeviz that holds a module, or the name of a module beside the folders."""
    return path.relative_to(PACKAGE).with_suffix("").parts[0]


def imports(path: Path) -> set[str]:
    """The dotted names a module imports, also inside functions."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: relative imports hide the layer"
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def imported_layers(path: Path) -> set[str]:
    """The layers of modeviz a module imports; a name of the package itself counts as `__init__`."""
    parts = (name.split(".") for name in imports(path) if name.split(".")[0] == "modeviz")
    second = {dotted[1] if len(dotted) > 1 else "__init__" for dotted in parts}
    known = set().union(*LAYERS)
    return {name if name in known else "__init__" for name in second}


def allowed(layer: str) -> set[str]:
    rank = next(i for i, names in enumerate(LAYERS) if layer in names)
    return NARROWER.get(layer, set().union(*LAYERS[:rank])) | {layer}


@pytest.mark.parametrize("path", MODULES, ids=lambda p: p.relative_to(PACKAGE).as_posix())
def test_module_imports_only_what_stands_before_it(path: Path):
    assert imported_layers(path) <= allowed(layer_of(path))


def users_of(library: str) -> list[str]:
    return [
        path.relative_to(PACKAGE).as_posix()
        for path in MODULES
        if any(name.split(".")[0] == library for name in imports(path))
    ]


def test_viser_is_imported_by_the_viewer_alone():
    assert {name.split("/")[0] for name in users_of("viser")} <= {"viewer"}


def test_pyfe3d_is_imported_by_one_module_of_fem():
    assert [name.split("/")[0] for name in users_of("pyfe3d")] == ["fem"]


def test_dask_is_imported_by_one_module_of_tuning():
    assert users_of("distributed") == ["tuning/cluster.py"]


@pytest.mark.parametrize("library", ["viser", "pyfe3d", "distributed", "dask"])
def test_importing_modeviz_leaves_the_viewer_and_the_extras_unloaded(library: str):
    program = f"import sys, modeviz; modeviz.solve; sys.exit({library!r} in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], cwd=CHECKOUT).returncode == 0


@pytest.mark.parametrize(
    "folder", ["modeviz", "tests", "examples", "assets", "benchmarks", "scripts", ".ci"]
)
def test_sources_name_no_machine_path(folder: str):
    texts = [p for p in (CHECKOUT / folder).rglob("*") if p.suffix in {"", ".py", ".sh", ".toml"}]
    for path in filter(Path.is_file, texts):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if not line.startswith("#!"):
                assert not MACHINE_PATH.search(line), f"{path}:{number}: {line.strip()}"

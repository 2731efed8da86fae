"""Who may import whom: a folder knows only what stands before it."""

import ast
import re
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).parents[1]
PACKAGE = CHECKOUT / "modeviz"

LAYERS = [
    {"errors"},
    {"units", "text", "compute"},
    {"vehicle"},
    {"files", "fem", "shapes", "dynamics"},
    {"formats"},
    {"ride"},
    {"mounting"},
    {"analysis"},
    {"optimise"},
    {"scatter"},
    {"report", "export"},
    {"journal"},
    {"viewer", "viewer.session"},
    {"viewer.tasks", "viewer.page"},
    {"viewer.scene"},
    {"viewer.pictures"},
    {"viewer.panels"},
    {"viewer.offline", "viewer.keeping", "viewer.inspection"},
    {"viewer.documents"},
    {"viewer.screen"},
    {"viewer.app"},
    {"viewer.rendering", "viewer.serving"},
    {"study"},
    {"public"},
    {"__init__"},
    {"cli"},
    {"__main__"},
]
"""From the ground up; what stands side by side knows nothing of each other."""

BEFORE_IN_PAGE = {
    "wire": (),
    "doors": ("wire",),
    "people": ("wire",),
    "widgets": ("wire", "people"),
}
"""Folders of the page; the modules beside them put them together."""

PRIVATE = re.compile(
    r"viser(?:\.\w+)* import _|viser\._|_websock_\w+|\._impl\b|_handle_from_node|_insert_message"
    r"|_queue_update"
)
"""Of viser: modules and members that begin with an underscore."""
MODULES = sorted(PACKAGE.rglob("*.py"))
MACHINE_PATH = re.compile(r"/(?:home|opt|private|root|tmp|Users|usr|work)/|\b[A-Z]:\\")


def layer_of(path: Path) -> str:
    """The folder of modeviz that holds a module, or the name of a module beside the folders."""
    return _layer(path.relative_to(PACKAGE).with_suffix("").parts)


def _layer(parts: Sequence[str]) -> str:
    """That of a module's name, in parts: within the viewer its folders are layers of their own."""
    inner = parts[0] == "viewer" and len(parts) > 1 and parts[1] != "__init__"
    return ".".join(parts[: 2 if inner else 1])


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
    parts = (name.split(".")[1:] for name in imports(path) if name.split(".")[0] == "modeviz")
    known = set().union(*LAYERS)
    found = {_layer(dotted) if dotted else "__init__" for dotted in parts}
    return {name if name in known else "__init__" for name in found}


def allowed(layer: str) -> set[str]:
    rank = next(i for i, names in enumerate(LAYERS) if layer in names)
    return set().union(*LAYERS[:rank]) | {layer}


@pytest.mark.parametrize("folder", BEFORE_IN_PAGE)
def test_a_folder_of_the_page_imports_only_those_that_stand_before_it(folder):
    modules = (PACKAGE / "viewer/page" / folder).glob("*.py")
    names = {name for path in modules for name in imports(path)}
    inside = {name.split(".")[3] for name in names if name.startswith("modeviz.viewer.page.")}
    assert folder in inside
    assert inside <= {folder, *BEFORE_IN_PAGE[folder]}


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


def test_only_the_page_leans_on_private_parts_of_viser():
    """Whatever of viser may change without notice is in one folder."""
    leaning = {
        path.relative_to(PACKAGE).as_posix() for path in MODULES if PRIVATE.search(path.read_text())
    }
    assert {name for name in leaning if not name.startswith("viewer/page/")} == set()


def test_pyfe3d_is_imported_by_one_module_of_fem():
    assert [name.split("/")[0] for name in users_of("pyfe3d")] == ["fem"]


def test_dask_is_imported_by_one_module_of_compute():
    assert users_of("distributed") == ["compute/cluster.py"]


def test_only_what_begins_work_limits_the_threads_of_blas():
    """A command, a study, an open page, a task on a worker, a pool of threads of ours."""
    assert users_of("threadpoolctl") == ["compute/threads.py"]
    limiting = {
        path.relative_to(PACKAGE).as_posix()
        for path in MODULES
        if "modeviz.compute.threads.one_thread" in imports(path)
    }
    study = {"study/output.py", "study/page.py", "study/study.py"}
    assert limiting == study | {"cli/__init__.py", "compute/cluster.py", "viewer/serving/serve.py"}


def test_importing_modeviz_leaves_the_viewer_and_the_extras_unloaded():
    assert loaded("modeviz.public", "viser", "pyfe3d", "distributed", "dask") == set()


def test_what_draws_loads_neither_statistics_nor_a_writer_of_meshes():
    assert loaded("modeviz.viewer.rendering", "scipy.stats", "trimesh") == set()


def loaded(module: str, *heavy: str) -> set[str]:
    """Those of some modules that come with another one."""
    program = f"import sys, {module}; print(*sys.modules.keys() & {set(heavy)!r})"
    run = subprocess.run([sys.executable, "-c", program], cwd=CHECKOUT, capture_output=True, text=True)
    assert not run.stderr
    return set(run.stdout.split())


@pytest.mark.parametrize(
    "folder", ["modeviz", "tests", "examples", "assets", "benchmarks", "scripts", ".ci"]
)
def test_sources_name_no_machine_path(folder: str):
    texts = [p for p in (CHECKOUT / folder).rglob("*") if p.suffix in {"", ".py", ".sh", ".toml"}]
    for path in filter(Path.is_file, texts):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if not line.startswith("#!"):
                assert not MACHINE_PATH.search(line), f"{path}:{number}: {line.strip()}"

"""The public surface: what `import modeviz` gives."""

import ast
import inspect

import modeviz
from modeviz import public

REEXPORTS = [
    alias
    for node in ast.parse(inspect.getsource(public)).body
    if isinstance(node, ast.ImportFrom)
    for alias in node.names
]
DEFINED = {
    alias.name: value
    for alias in REEXPORTS
    if inspect.isclass(value := getattr(modeviz, alias.name)) or inspect.isfunction(value)
}


def test_names_are_reexported_explicitly():
    assert [a.name for a in REEXPORTS if a.asname != a.name] == []


def test_nothing_else_is_public():
    names = {name for name in dir(modeviz) if not inspect.ismodule(getattr(modeviz, name))}
    assert {name for name in names if not name.startswith("_")} == {a.name for a in REEXPORTS}


def test_functions_and_classes_are_documented():
    def is_documented(name: str) -> bool:
        """Whether a person wrote it: a dataclass without a docstring repeats its signature."""
        text = DEFINED[name].__doc__ or ""
        return bool(text) and not text.startswith(f"{name}(")

    assert [name for name in DEFINED if not is_documented(name)] == []

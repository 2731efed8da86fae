"""The public surface: what `import modeviz` gives."""

import ast
import inspect
from functools import cached_property
from types import FunctionType

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


def members(cls: type) -> dict[str, object]:
    """What a class of ours offers under names that are public, by its full name."""
    owners = [base for base in cls.__mro__ if base.__module__.startswith("modeviz.")]
    return {
        f"{cls.__name__}.{name}": member
        for owner in owners
        for name, member in vars(owner).items()
        if not name.startswith("_")
        and isinstance(member, property | cached_property | FunctionType | classmethod)
    }


MEMBERS = {
    name: member
    for cls in DEFINED.values()
    if inspect.isclass(cls)
    for name, member in members(cls).items()
}


def test_methods_and_properties_are_documented():
    assert [name for name, member in MEMBERS.items() if not inspect.getdoc(member)] == []


def test_methods_and_properties_say_what_they_return():
    def function(member: object) -> FunctionType:
        found = getattr(member, "fget", None) or getattr(member, "func", None)
        return found or getattr(member, "__func__", member)

    unsaid = [n for n, m in MEMBERS.items() if "return" not in function(m).__annotations__]
    assert unsaid == []

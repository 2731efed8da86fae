"""Nothing in the package is there for its tests alone."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import modeviz.public

CHECKOUT = Path(__file__).parents[1]

USERS = ("modeviz", "examples", "assets", "benchmarks")
"""Folders that use the package; README and docs tell people of some more."""

CALLED_BY_OTHERS = {"writable", "request_share_url", "_repr_html_", "get_loop", "is_serving"}
"""Methods of io.IOBase, of viser's server, of notebooks, of asyncio's servers."""


def definitions(tree: ast.Module) -> Iterator[str]:
    """Names of the functions and classes of a module, and of methods but those of public classes."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        if isinstance(node, ast.ClassDef) and not hasattr(modeviz.public, node.name):
            yield from (each.name for each in node.body if isinstance(each, ast.FunctionDef))


def used(tree: ast.Module) -> Iterator[str]:
    """Names that a module uses, also in strings of one word; an import alone is no use."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
            yield node.id
        elif isinstance(node, ast.Attribute):
            yield node.attr
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield from re.findall(r"\w+", node.value if " " not in node.value else "")


def test_every_function_is_used_by_something_that_is_no_test():
    trees = {p: ast.parse(p.read_text()) for name in USERS for p in (CHECKOUT / name).rglob("*.py")}
    pages = [CHECKOUT / "README.md", *(CHECKOUT / "docs").glob("*.md")]
    told = {word for page in pages for span in re.findall(r"`[^`]+`", page.read_text())
            for word in re.findall(r"\w+", span)}  # fmt: skip
    known = {*vars(modeviz.public), *told, *CALLED_BY_OTHERS}
    known.update(*map(used, trees.values()))
    unused = {
        f"{path.relative_to(CHECKOUT)}: {name}"
        for path, tree in trees.items()
        if (CHECKOUT / "modeviz") in path.parents
        for name in definitions(tree)
        if name not in known and not re.fullmatch(r"__\w+__", name)
    }
    assert unused == set()

"""What the gate leaves out is listed, with where its claims stand within the gate."""

import re
from pathlib import Path

TESTS = Path(__file__).parent
LISTED = (TESTS / "README.md").read_text()
SLOW = re.compile(r"@pytest\.mark\.slow\n(?:@.*\n)*def (test_\w+)")


def slow_tests() -> set[str]:
    """Names of tests marked so, and of files that are as a whole."""
    texts = {path: path.read_text() for path in TESTS.rglob("test_*.py") if path != Path(__file__)}
    files = {path.name for path, text in texts.items() if "pytestmark = pytest.mark.slow" in text}
    return files | {name for text in texts.values() for name in SLOW.findall(text)}


def test_every_slow_test_is_listed():
    rows = set(re.findall(r"^\| `(test_[\w.]+)`", LISTED, re.MULTILINE))
    assert rows - {"test_independent_solver.py"} == slow_tests()


def test_what_stands_in_for_it_is_there():
    texts = "".join(path.read_text() for path in TESTS.rglob("test_*.py"))
    files = {path.relative_to(TESTS).as_posix() for path in TESTS.rglob("test_*.py")}
    names = {path.split("/")[-1] for path in files}
    for word in re.findall(r"`([\w/]*test_[\w.:]+)`", LISTED):
        *file, name = word.split("::")
        is_file = name.endswith(".py")
        assert (name in files | names) if is_file else f"def {name}(" in texts, word
        assert not file or file[0] in files | names, word

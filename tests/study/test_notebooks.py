"""The pages that are open in a process: few, and none of a cell that was run again."""

import subprocess
import sys

from modeviz.study.notebooks import MOST_OPEN, OpenPages, is_notebook, this_cell


class Opened:
    def __init__(self) -> None:
        self.n_closed = 0

    def close(self) -> None:
        self.n_closed += 1


def n_open(pages):
    return sum(not page.n_closed for page in pages)


def test_without_a_notebook_there_is_none_and_no_cell():
    assert not is_notebook()
    assert this_cell() == ""


def test_a_cell_has_one_page():
    opened, pages = OpenPages(), [Opened() for _ in range(5)]
    for page in pages:
        opened.add(page, "same")
    assert [page.n_closed for page in pages] == [1, 1, 1, 1, 0]


def test_where_cells_are_not_known_the_oldest_of_many_is_closed():
    opened, pages = OpenPages(), [Opened() for _ in range(MOST_OPEN + 3)]
    for page in pages:
        opened.add(page, "")
    assert [page.n_closed for page in pages] == [1] * 3 + [0] * MOST_OPEN


def test_what_is_forgotten_is_not_closed_again_and_leaves_its_place():
    opened, pages = OpenPages(), [Opened() for _ in range(MOST_OPEN + 1)]
    for page in pages[:-1]:
        opened.add(page, "")
    opened.forget(pages[0])
    opened.add(pages[-1], "")
    assert n_open(pages) == len(pages)
    opened.close()
    assert [page.n_closed for page in pages] == [0] + [1] * MOST_OPEN


def test_what_is_open_is_closed_when_the_process_ends():
    script = """
from modeviz.study.notebooks import OpenPages
class Opened:
    def close(self): print("closed")
OpenPages().add(Opened(), "")
"""
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout == "closed\n"

"""Fewer changes that come to the same: for as long as nothing can be written they are all in memory."""

from collections.abc import Sequence
from dataclasses import replace

from modeviz.journal.changes import LONGEST, Change, Difference

MERGED = "Earlier changes, as one: nothing could be saved"

INVERSE = {"undo": "redo", "redo": "undo"}
"""Kinds that take each other back."""

GOES_ON = ("step", "longer")
"""Kinds that a longer change is one with."""

ENDS = (*GOES_ON, "undo")
"""Kinds after which it is known whether something can be redone: of what was before nothing is."""


def compacted(changes: Sequence[Change]) -> tuple[Change, ...]:
    """Return changes after which the same can be undone and redone, `LONGEST` steps far.

    What they leave out is undone or goes on in others: a drag, a step that was undone before another
    one was made, or undone and redone. Steps so long ago that nobody can undo them any more are one.
    After the last of them rates are as after all; how one looked may have been another.

    Args:
        changes: of one session, the first one first, after whatever was written before.
    """
    kept: list[Change] = []
    for change in changes:
        _put(kept, change)
    return _with_first_merged(kept)


def _put(kept: list[Change], change: Change) -> None:
    """Adds a change, or takes away what it takes back."""
    last = kept[-1].kind if kept else ""
    if change.kind == "longer" and last in GOES_ON:
        kept[-1] = replace(change, kind=kept[-1].kind)
    elif change.kind == "back" and last == "longer":  # of a step that was there before
        kept[-1] = change
    elif INVERSE.get(change.kind) == last or (
        (last, change.kind) == ("step", "back") and not _may_redo(kept[:-1])
    ):
        kept.pop()
    else:
        if change.kind == "step":
            _forget_undone(kept)
        kept.append(change)


def _may_redo(kept: Sequence[Change]) -> bool:
    """Whether steps may be at hand to be redone, which any other step makes unreachable."""
    last = next((change.kind for change in reversed(kept) if change.kind in ENDS), "undo")
    return last == "undo"


def _forget_undone(kept: list[Change]) -> None:
    """Leaves out steps at the end that were undone one after the other, as nobody can redo them."""
    n_undone = 0
    while n_undone < len(kept) and kept[-1 - n_undone].kind == "undo":
        n_undone += 1
    undone = kept[len(kept) - n_undone :]
    del kept[len(kept) - n_undone :]
    while undone and kept and kept[-1].kind == "step":
        kept.pop()
        undone.pop(0)
    kept += undone


def _with_first_merged(kept: Sequence[Change]) -> tuple[Change, ...]:
    """Makes one of the first steps that follow each other, of those that nobody can undo."""
    stay = [i for i, change in enumerate(kept) if change.kind == "step" and not _is_back(kept, i + 1)]
    numbers = stay[:-LONGEST]
    steps = [kept[i] for n, i in enumerate(numbers) if i == numbers[0] + n]
    if len(steps) < 2:
        return tuple(kept)
    merged = replace(
        steps[-1],
        title=MERGED,
        before=steps[0].before,
        differences=_merged(steps),
        maker=steps[0].maker if len({step.maker for step in steps}) == 1 else "",
    )
    return (*kept[: numbers[0]], merged, *kept[numbers[0] + len(steps) :])


def _is_back(kept: Sequence[Change], i: int) -> bool:
    return i < len(kept) and kept[i].kind == "back"


def _merged(steps: Sequence[Change]) -> tuple[Difference, ...]:
    """In what all these steps together differ."""
    found: dict[str, Difference] = {}
    for step in steps:
        for each in step.differences:
            before = found.get(each.what, each).before
            found[each.what] = Difference(each.what, before, each.after)
    return tuple(each for each in found.values() if each.before != each.after)

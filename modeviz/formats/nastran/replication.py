"""Cards that say only how they differ from the one before.

After MSC Nastran's Quick Reference Guide, "Automatic Generation": = stands for the field before, == for
all that follow, and *(x) or *x for that field and x more.
"""

import re

from modeviz.errors import VehicleError, quoted

STEP = re.compile(r"\*\s*\(?\s*([^()]+?)\s*\)?")


def replica(before: list[str], pattern: list[str]) -> list[str]:
    """Return the fields of a card.

    Args:
        before: fields of the card before it.
        pattern: what its own line has in their place.

    Raises:
        VehicleError: a field is to be increased that is no number.
    """
    fields = []
    for number, text in enumerate(pattern):
        if text == "==":
            return fields + before[number:]
        own = before[number] if number < len(before) else ""
        step = STEP.fullmatch(text)
        fields.append(own if text == "=" else _increased(own, step[1]) if step else text)
    return fields


def _increased(text: str, step: str) -> str:
    """A number and a step together, whole if both are; nothing counts as zero."""
    text = text or "0"
    try:
        return str(int(text) + int(step))
    except ValueError:
        pass
    try:
        return repr(float(text) + float(step))
    except ValueError:
        raise VehicleError(f"found {quoted(text)} to be increased by {quoted(step)}") from None

"""What somebody remarked on a study, and of what."""

from dataclasses import dataclass
from typing import Literal

from modeviz.errors import ModevizError

PinnedTo = Literal["study", "variant", "mode", "mount"]

LONGEST_NOTE = 10_000
"""Letters."""


@dataclass(frozen=True)
class Note:
    """A remark, pinned to something or to the whole study."""

    text: str
    kind: PinnedTo = "study"
    name: str = ""
    """Of the variant, mode or mount (or its group); empty of the whole study."""
    author: str = ""
    time: float = 0.0
    """When it was written, s since 1970."""
    token: str = ""
    """By which it is found again."""
    is_for_all: bool = False
    """Whether every session of the study has it."""

    def __post_init__(self) -> None:
        try:
            "".join((self.text, self.name, self.author)).encode()
        except UnicodeEncodeError:
            raise ModevizError("a note: found bytes that are no letters") from None
        if not self.text.strip():
            raise ModevizError("a note: found no text")
        if len(self.text) > LONGEST_NOTE:
            raise ModevizError(
                f"a note: found {len(self.text):,} letters, expected {LONGEST_NOTE:,} at most"
            )
        if (self.kind == "study") == bool(self.name):
            raise ModevizError("a note: expected a name of a variant, a mode or a mount, and no other")

    @property
    def about(self) -> str:
        """What it is pinned to, in words: "mode cab yaw"; of the whole study "study"."""
        return f"{self.kind} {self.name}".strip()

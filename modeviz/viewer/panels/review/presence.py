"""What one page is told of who is there."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from modeviz.viewer.page.people.acquaintances import Visitor
from modeviz.viewer.page.widgets.html import heading, named, row, span, table


@dataclass(frozen=True)
class Presence:
    """What one page is told of who is there."""

    you: Visitor
    there: Sequence[Visitor]
    presenter: Visitor | None
    """None: the owner."""
    has_control: bool
    link: str
    is_shared: bool
    can_share: bool
    title: str
    """What the owner calls the session."""

    @property
    def presenter_name(self) -> str:
        """What who is in control is called; "Nobody" while no owner is there who has it."""
        owners = (each for each in self.there if each.is_owner)
        presenter = self.presenter or next(owners, None)
        return presenter.name if presenter else "Nobody"

    @property
    def takers(self) -> Sequence[Visitor]:
        """Who could be handed control here; an owner takes it back."""
        others = (each for each in self.there if not self.presents(each))
        return [each for each in others if not (each.is_owner and self.you.is_owner)]

    def presents(self, visitor: Visitor) -> bool:
        """Whether a visitor is in control."""
        if self.presenter is None:
            return visitor.is_owner
        return visitor.number == self.presenter.number


def linked(link: str) -> str:
    """The link of a review; one that was made before is known to those alone who have it."""
    if not link:
        text = (
            "Shared by a link of before, which cannot be shown again: it is stored nowhere, so that "
            "nobody finds it. A new link opens the review too; to replace it ends the old one and puts "
            "its visitors out."
        )
        return span(text, "dim")
    kept = span("It is stored nowhere: keep it, if it is to be given out later.", "dim")
    return f'<a href="{escape(link)}" target="_blank">The link of this review</a><br>{kept}'


def listing(now: Presence) -> str:
    """What the session is called, and who is there, a line for each."""
    rows = []
    for each in now.there:
        presents = now.presents(each)
        marks = ["owner"] if each.is_owner else []
        marks += ["presents"] if presents and len(now.there) > 1 else []
        marks += ["you"] if each.number == now.you.number else []
        rows.append(row([named(each.name), span(", ".join(marks), "dim")], chosen=presents))
    title = heading(named(now.title)) if now.title else ""
    return f"{title}{table((), rows, 'visitors')}"

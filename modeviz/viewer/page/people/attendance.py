"""Who looks at which page of a session, and who of them is in control."""

from collections.abc import Sequence

from modeviz.viewer.page.people.acquaintances import Acquaintances, Visitor


class Attendance:
    """Visitors by their pages, for one thread at a time; in control is the owner, or one visitor."""

    def __init__(self) -> None:
        """Nobody is there."""
        self._known = Acquaintances()
        self._pages: dict[int, str] = {}
        """The keys of who looks, by page."""
        self._presenter = ""
        """The key of the visitor who is in control; "" while the owner is."""

    @property
    def there(self) -> Sequence[Visitor]:
        """Who looks now, the owner first, then as they came."""
        present = {v.number: v for key in self._pages.values() if (v := self._known.get(key))}
        return sorted(present.values(), key=lambda each: (not each.is_owner, each.number))

    @property
    def presenter(self) -> Visitor | None:
        """The visitor who was handed control; None: the owner has it."""
        return self._known.get(self._presenter)

    @property
    def guest_pages(self) -> Sequence[int]:
        """Those that are not the owner's."""
        seen = ((page, self.of_page(page)) for page in self._pages)
        return [page for page, visitor in seen if visitor is None or not visitor.is_owner]

    def of_page(self, page: int) -> Visitor | None:
        """Return who looks at a page, if it is open."""
        return self._known.get(self._pages.get(page, ""))

    def of_key(self, key: str) -> Visitor | None:
        """Return who has a key, if that is known."""
        return self._known.get(key)

    def has_control(self, page: int) -> bool:
        """Whether a page may change the session."""
        visitor = self.of_page(page)
        return visitor is not None and self._is_in_control(visitor)

    def enter(self, page: int, key: str, name: str, is_owner: bool) -> None:
        """Notes who looks at a page.

        Args:
            page: that was opened.
            key: of who did.
            name: that a newcomer would like; "" for none.
            is_owner: whether the session is the visitor's own.
        """
        self._known.meet(key, name, is_owner, self.there)
        self._pages[page] = key
        self._known.forget({*self._pages.values(), self._presenter})

    def leave(self, page: int) -> str | None:
        """Forgets a page; returns the key of who looked at it, if anybody did."""
        return self._pages.pop(page, None)

    def rename(self, page: int, name: str) -> Visitor | None:
        """Gives who looks at a page another name, or one like it that is free; "" gives none."""
        return self._known.rename(self._pages.get(page, ""), name, self.there)

    def hand_over(self, by: int, number: int) -> Visitor | None:
        """Puts somebody who is there in control; see `Visitors.hand_over`."""
        giver = self.of_page(by)
        taker = next((each for each in self.there if each.number == number), None)
        if giver is None or taker is None:
            return None
        if not (giver.is_owner or self._is_in_control(giver)):
            return None
        self._presenter = "" if taker.is_owner else self._key(taker)
        return taker

    def is_away(self, key: str) -> bool:
        """Whether somebody is in control who has no page open."""
        return key == self._presenter and key not in self._pages.values()

    def take_back(self) -> None:
        """Puts the owner in control."""
        self._presenter = ""

    def _key(self, visitor: Visitor) -> str:
        """Return the key of somebody who is there."""
        return next(key for page, key in self._pages.items() if self.of_page(page) == visitor)

    def _is_in_control(self, visitor: Visitor) -> bool:
        presenter = self.presenter
        return visitor.is_owner if presenter is None else visitor.number == presenter.number

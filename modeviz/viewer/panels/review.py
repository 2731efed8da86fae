"""Left column: who is there, who presents, and the link of a review; each page has its own."""

import math
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from html import escape

import viser

from modeviz.viewer.page import scripts
from modeviz.viewer.page.handles import assign, name_of
from modeviz.viewer.page.html import block, row, span, table
from modeviz.viewer.page.server import Server
from modeviz.viewer.page.visitors import Visitor, Visitors
from modeviz.viewer.page.write_back import WriteBack
from modeviz.viewer.session.worker import Worker

COPY, STOP = "Copy link", "Stop sharing"
NOBODY = "–"


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

    @property
    def is_away(self) -> bool:
        """Whether nobody is there who could change something."""
        return self.presenter is None and not any(each.is_owner for each in self.there)

    @property
    def presenter_name(self) -> str:
        """What who is in control is called."""
        owners = (each for each in self.there if each.is_owner)
        presenter = self.presenter or next(owners, None)
        return presenter.name if presenter else NOBODY

    @property
    def others(self) -> Sequence[Visitor]:
        """Who could be handed control."""
        return [each for each in self.there if not self.presents(each)]

    def presents(self, visitor: Visitor) -> bool:
        """Whether a visitor is in control."""
        if self.presenter is None:
            return visitor.is_owner
        return visitor.number == self.presenter.number


class ReviewCard:
    """The folder of one page."""

    def __init__(
        self, client: viser.ClientHandle, visitors: Visitors, follow: Callable[[str | None], None]
    ) -> None:
        """Builds the controls; `show` fills them.

        Args:
            client: the page.
            visitors: whom it is about.
            follow: lets the page's camera follow who presents, given its checkbox; None: no longer.
        """
        self._client, self._visitors = client, visitors
        self._write_back, self._follow_presenter = WriteBack(), follow
        self._now: Presence | None = None
        self._said: dict[str, object] = {}
        self._numbers: dict[str, int] = {}
        you = visitors.of_page(client.client_id)
        gui = client.gui
        with gui.add_folder("Review", expand_by_default=you is not None and not you.is_owner):
            self._list = gui.add_html("")
            self._name = gui.add_text("You are", you.name if you else "", hint="Your name for others")
            self._follow = gui.add_checkbox(
                "Follow", True, hint="Your camera goes where that of who presents goes"
            )
            self._share = gui.add_button(
                "Share…", hint="Makes a link: who opens it sees all you see, and changes nothing"
            )
            self._link = gui.add_html("")
            self._links = gui.add_button_group(
                "Link", (COPY, STOP), hint="Copies it for a message; ends the review for all visitors"
            )
            self._to = gui.add_dropdown("Hand over to", (NOBODY,), hint="Who is to present")
            self._hand_over = gui.add_button("Hand over", hint="The owner can always take control back")
            self._take_back = gui.add_button("Take control back", hint="You present again")
        self._name.on_update(lambda _: self._write_back.touch(self._name, self._rename))
        self._follow.on_update(lambda _: self._turn())
        self._share.on_click(lambda _: self._begin_review())
        self._links.on_click(lambda _: self._use_link(self._links.value))
        self._hand_over.on_click(lambda _: self._give(self._numbers.get(self._to.value)))
        self._take_back.on_click(lambda _: self._give(self._you.number if self._you else None))
        follow(name_of(self._follow))

    def show(self, now: Presence) -> None:
        """Shows who is there and what one can do about it here."""
        you = now.you
        self._numbers = {each.name: each.number for each in now.others}
        may_give = (you.is_owner or now.has_control) and bool(self._numbers)
        assign(self._list, content=f'<div class="mv-own">{block(_listing(now))}</div>')
        if self._you is None or you.name != self._you.name:  # else somebody may be typing
            assign(self._name, value=you.name)
        assign(self._follow, visible=not now.has_control)
        assign(self._share, visible=you.is_owner and now.can_share and not now.is_shared)
        assign(self._link, content=block(_linked(now.link)) if you.is_owner and now.is_shared else "")
        assign(self._links, visible=you.is_owner and now.is_shared)
        assign(self._to, options=tuple(self._numbers) or (NOBODY,), visible=may_give)
        assign(self._hand_over, visible=may_give)
        assign(self._take_back, visible=you.is_owner and not now.has_control)
        self._now = now
        self._say(now)

    @property
    def _you(self) -> Visitor | None:
        return self._now.you if self._now else None

    def _say(self, now: Presence) -> None:
        """Has the page say that nothing can be changed here, and who can."""
        text, actions = "", []
        if not now.has_control:
            who = "Nobody presents" if now.is_away else f"{now.presenter_name} presents"
            text = f"{who} – you are looking"
            if not self._follow.value:
                actions.append({"words": "Follow", "widget": name_of(self._follow)})
            if now.you.is_owner:
                actions.append({"words": "Take back", "widget": name_of(self._take_back)})
        said = {"text": text, "actions": actions, "looks": not now.has_control}
        if said != self._said:
            self._said = said
            scripts.run(self._client.gui, "page/presence.js", said)

    def _turn(self) -> None:
        """Follows or not, as the checkbox says, which this page may have set by turning its camera."""
        self._write_back.touch(self._follow)
        self._follow_presenter(name_of(self._follow) if self._follow.value else None)
        if self._now:
            self._say(self._now)

    def _rename(self) -> None:
        named = self._visitors.rename(self._client.client_id, self._name.value)
        if named:
            assign(self._name, value=named.name)
            scripts.run(self._client.gui, "page/remember_name.js", named.name)

    def _begin_review(self) -> None:
        if self._you and self._you.is_owner:
            scripts.run(self._client.gui, "page/copy.js", self._visitors.share())

    def _use_link(self, button: str) -> None:
        if not (self._you and self._you.is_owner):
            return
        if button == STOP:
            self._visitors.stop_sharing()
        else:
            scripts.run(self._client.gui, "page/copy.js", self._visitors.link or self._visitors.share())

    def _give(self, number: int | None) -> None:
        if number is None or self._visitors.hand_over(self._client.client_id, number) is None:
            self._client.add_notification(
                "Not handed over", "Who was to present has left.", color="red"
            )


class ReviewPanel:
    """The folders of all pages."""

    def __init__(self, server: Server, follow: Callable[[int, str | None], None]) -> None:
        """Builds one on every page that comes.

        Args:
            server: of the session.
            follow: lets the camera of a page follow who presents, or no longer; as `Following.switch`.
        """
        self._visitors, self._follow = server.visitors, follow
        self._lock = threading.RLock()
        self._cards: dict[int, ReviewCard] = {}
        self._pointed_out: dict[int, float] = {}
        self._teller: Worker[bool] = Worker(lambda _: self._show_all(), server.mistake)
        server.on_client_connect(self._add)
        server.on_client_disconnect(self._drop)
        self._visitors.on_change(lambda: self._teller.submit(True))
        self._visitors.on_refusal(self._point_out)
        self._server = server

    def close(self) -> None:
        """Tells nobody any more."""
        self._teller.close()

    def _add(self, client: viser.ClientHandle) -> None:
        page = client.client_id
        if self._visitors.of_page(page) is None:  # a browser of ours, which takes pictures
            return
        with self._lock:
            self._cards[page] = ReviewCard(client, self._visitors, partial(self._follow, page))
            self._show(page)
        if self._visitors.of_page(page) is None:  # it has left meanwhile
            self._drop(client)

    def _drop(self, client: viser.ClientHandle) -> None:
        with self._lock:
            self._cards.pop(client.client_id, None)
            self._pointed_out.pop(client.client_id, None)

    def _show_all(self) -> None:
        with self._lock:
            for page in tuple(self._cards):
                self._show(page)

    def _show(self, page: int) -> None:
        visitors, you = self._visitors, self._visitors.of_page(page)
        if you is None or page not in self._cards:
            return
        has_control = visitors.has_control(page)
        self._cards[page].show(
            Presence(
                you,
                visitors.there,
                visitors.presenter,
                has_control,
                visitors.link,
                visitors.is_shared,
                visitors.can_share,
            )
        )

    def _point_out(self, page: int) -> None:
        """Points out on a page that it may not change anything, at most twice a second."""
        client, now = self._server.get_clients().get(page), time.monotonic()
        if client is not None and now - self._pointed_out.get(page, -math.inf) > 0.5:
            self._pointed_out[page] = now
            scripts.run(client.gui, "page/refused.js")


def _linked(link: str) -> str:
    """The link of a review; one that was made before is known to those alone who have it."""
    if not link:
        return span("Shared by a link that was made before; a copy is another link.", "dim")
    return f'<a href="{escape(link)}" target="_blank">The link of this review</a>'


def _listing(now: Presence) -> str:
    """Who is there, a line for each."""
    rows = []
    for each in now.there:
        presents = now.presents(each)
        marks = ["owner"] if each.is_owner else []
        marks += ["presents"] if presents and len(now.there) > 1 else []
        marks += ["you"] if each.number == now.you.number else []
        rows.append(row([escape(each.name), span(", ".join(marks), "dim")], chosen=presents))
    return table((), rows)

"""The folder of one page: who is there, who presents, and the link of the review."""

from collections.abc import Callable

import viser

from modeviz.errors import ModevizError
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.people.acquaintances import Visitor
from modeviz.viewer.page.people.visitors import Visitors
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import assign, name_of
from modeviz.viewer.page.widgets.html import block
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.review.presence import Presence, linked, listing
from modeviz.viewer.session.session_title import SessionTitle

COPY, STOP = "Copy link", "Stop sharing"
ANOTHER, REPLACE = "New link", "Replace link"
"""Where the link of before is not known any more: it stays, or ends."""
NOBODY = "–"


class ReviewCard:
    """The folder of one page."""

    def __init__(
        self,
        client: viser.ClientHandle,
        visitors: Visitors,
        title: SessionTitle,
        follow: Callable[[str | None], None],
    ) -> None:
        """Builds the controls; `show` fills them.

        Args:
            client: the page.
            visitors: whom it is about.
            title: of the session.
            follow: lets the page's camera follow who presents, given its checkbox; None: no longer.
        """
        self._client, self._visitors, self._session_title = client, visitors, title
        self._write_back, self._follow_presenter = WriteBack(), follow
        self._now: Presence | None = None
        self._said: dict[str, object] = {}
        self._numbers: dict[str, int] = {}
        you = visitors.of_page(client.client_id)
        gui = client.gui
        with gui.add_folder("Review", expand_by_default=you is not None and not you.is_owner):
            self._list = gui.add_html("")
            self._title = gui.add_text(
                "Session",
                title.text,
                hint="What you call this session: on the start page, in the study and for visitors",
            )
            self._name = gui.add_text("You are", you.name if you else "", hint="Your name for others")
            self._follow = gui.add_checkbox(
                "Follow", True, hint="Your camera goes where that of who presents goes"
            )
            self._share = gui.add_button(
                "Share…", hint="Makes a link: who opens it sees all you see, and changes nothing"
            )
            self._link = gui.add_html("")
            self._links = gui.add_button_group(
                "Link", (COPY, STOP), hint="For a message; to stop ends the review for all visitors"
            )
            self._to = gui.add_dropdown("Hand over to", (NOBODY,), hint="Who is to present")
            self._hand_over = gui.add_button("Hand over", hint="The owner can always take control back")
            self._take_back = gui.add_button("Take control back", hint="You present again")
        self._title.on_update(lambda _: self._write_back.touch(self._title, self._name_session))
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
        self._numbers = {each.name: each.number for each in now.takers}
        may_give = (you.is_owner or now.has_control) and bool(self._numbers)
        assign(self._list, content=f'<div class="mv-own">{block(listing(now))}</div>')
        if self._you is None or you.name != self._you.name:  # else somebody may be typing
            assign(self._name, value=you.name)
        if self._now is None or now.title != self._now.title:
            assign(self._title, value=now.title)
        assign(self._title, visible=you.is_owner)
        assign(self._follow, visible=not now.has_control)
        assign(self._share, visible=you.is_owner and now.can_share and not now.is_shared)
        assign(self._link, content=block(linked(now.link)) if you.is_owner and now.is_shared else "")
        buttons = (COPY, STOP) if now.link else (ANOTHER, REPLACE, STOP)
        assign(self._links, options=buttons, visible=you.is_owner and now.is_shared)
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
            text = f"{now.presenter_name} presents – you are looking"
            if not self._follow.value:
                actions.append({"words": "Follow", "widget": name_of(self._follow)})
            if now.you.is_owner:
                actions.append({"words": "Take back", "widget": name_of(self._take_back)})
        said = {"text": text, "actions": actions, "looks": not now.has_control}
        if said != self._said:
            self._said = said
            scripts.run(self._client.gui, "page/browser/presence.js", said)

    def _turn(self) -> None:
        """Follows or not, as the checkbox says, which this page may have set by turning its camera."""
        self._write_back.touch(self._follow)
        self._follow_presenter(name_of(self._follow) if self._follow.value else None)
        if self._now:
            self._say(self._now)

    def _rename(self) -> None:
        visitor = self._visitors.rename(self._client.client_id, self._name.value)
        if visitor:
            assign(self._name, value=visitor.name)
            scripts.run(self._client.gui, "page/browser/remember_name.js", visitor.name)

    def _name_session(self) -> None:
        if not (self._you and self._you.is_owner):
            return
        try:
            self._session_title.put(self._title.value)
        except ModevizError as refusal:
            text = f"{sentence_case(str(refusal))}."
            self._client.add_notification("Not named", text, color="red")

    def _begin_review(self) -> None:
        if self._you and self._you.is_owner:
            self._copy()

    def _use_link(self, button: str) -> None:
        if not (self._you and self._you.is_owner):
            return
        if button in (STOP, REPLACE):
            self._visitors.stop_sharing()
        if button != STOP:
            self._copy()

    def _copy(self) -> None:
        """Copies the link of the review on this page; makes one if it is not known."""
        try:
            link = self._visitors.link or self._visitors.share()
        except ModevizError as refusal:
            self._client.add_notification("Not shared", str(refusal), color="red")
        else:
            scripts.run(self._client.gui, "page/browser/copy.js", link)

    def _give(self, number: int | None) -> None:
        if number is None or self._visitors.hand_over(self._client.client_id, number) is None:
            self._client.add_notification(
                "Not handed over", "Who was to present has left.", color="red"
            )

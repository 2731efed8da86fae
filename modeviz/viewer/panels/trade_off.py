"""Left column: a front of designs between two goals, on which a click loads one."""

import threading
from contextlib import suppress
from html import escape

import viser

from modeviz.errors import ModevizError
from modeviz.optimise.pareto import largest_difference, most_truncated
from modeviz.optimise.trade_off import ParetoPoint
from modeviz.report.truncation import at_rates, is_large
from modeviz.text.axes import Axis
from modeviz.text.wording import sentence_case, significant
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, span
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.panels.status import ALARMING, percent
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.background_task import Job
from modeviz.viewer.tasks.front_task import Designs, FrontTask, Goals
from modeviz.viewer.tasks.search_task import design_of

FIND, CANCEL = "Find front", "Cancel"
NOTHING = "Nothing"
N_POINTS = 24
MARGIN = 0.06
"""Of the axes' length, between the outermost points and the frame."""


class TradeOffPanel:
    """Chooses two goals, finds their front, and shows it."""

    def __init__(self, gui: viser.GuiApi, session: Session, trader: FrontTask) -> None:
        """Builds the controls; nothing where nothing can be traded."""
        self._session, self._trader = session, trader
        self._lock = threading.Lock()
        self._is_built = session.state.design.plan is not None
        if not self._is_built:
            return
        self._names = {NOTHING: ""}
        self._folder = gui.add_folder("Trade-off", visible=False)
        with self._folder:
            self._points = NamedButtons[ParetoPoint](gui, trader.load)
            self._between = gui.add_dropdown(
                "Between",
                (NOTHING,),
                hint="Two goals out of the problem above; on their front neither can fall any more "
                "unless the other rises",
            )
            self._buttons = gui.add_button_group(
                "Front",
                (FIND,),
                hint="Looks for designs from the best in one goal to the best in the other; takes a "
                "while. Click on one to load its rates",
            )
            self._buttons.on_click(lambda event: self._press(event))
            self._front = gui.add_html("")
        self._offer()

    def follow(self) -> None:
        """Draws the front as far as it is found; may be called in any thread."""
        if not self._is_built:
            return
        with self._lock:
            job = self._trader.job
            self._offer()
            assign(self._buttons, options=(CANCEL,) if job and job.is_running else (FIND,))
            if job:
                assign(self._front, content=block(where(job), self._chart(job)))

    def _offer(self) -> None:
        """Offers what can be traded; what was offered stays while the plan cannot be."""
        with suppress(ModevizError):
            offers = self._trader.offers()
            assign(self._folder, visible=bool(offers))
            if offers:
                self._names = {sentence_case(name): name for name in offers}
                assign(self._between, options=tuple(self._names))

    def _press(self, event: viser.GuiEvent) -> None:
        if self._buttons.value == CANCEL:
            self._trader.cancel()
            return
        try:
            self._trader.start(self._names.get(self._between.value, ""))
        except ModevizError as error:
            if event.client:
                refuse(event.client, str(error))

    def _chart(self, job: Job[Goals, Designs]) -> str:
        """The designs where both goals have them, as points that can be clicked."""
        designs = (job.found or ())[:N_POINTS]
        self._points.keep(designs)
        if not designs:
            return ""
        across, up = (axis([design.values[i] for design in designs]) for i in (0, 1))
        first, second = map(escape, job.asked.names)
        points = []
        for design in designs:
            a, b = design.values
            hint = f"{first} {significant(a)}, {second} {significant(b)}: click to load"
            is_present = (design.rates, design.placements) == design_of(self._session.state)
            place = f"left:{100 * float(across.place(a)):.1f}%;bottom:{100 * float(up.place(b)):.1f}%"
            point = self._points.label(design, f'<span title="{hint}"></span>')
            points.append(f'<div class="{"on" if is_present else ""}" style="{place}">{point}</div>')
        ticks = [*_ticks(across, "left"), *_ticks(up, "bottom")]
        named = f'<div class="dim">{sentence_case(second)} ↑ &nbsp; {sentence_case(first)} →</div>'
        return f'{named}<div class="front">{"".join(ticks)}{"".join(points)}</div>'


def axis(values: list[float]) -> Axis:
    """An axis that holds values, and a little more."""
    low, high = min(values), max(values)
    margin = MARGIN * ((high - low) or abs(high) or 1.0)
    return Axis("", low - margin, high + margin)


def _ticks(of: Axis, side: str) -> list[str]:
    """The round values of an axis, where they are."""
    every = 2 if len(of.ticks()) > 5 else 1
    return [
        f'<i class="{side}" style="{side}:{100 * float(of.place(value)):.1f}%">{text}</i>'
        for value, text in of.ticks()[::every]
    ]


def where(job: Job[Goals, Designs]) -> str:
    """A line on how far the search is, and what the full model says of what it found."""
    n = len(job.found or ())
    designs = f"{n} design{'' if n == 1 else 's'}"
    if job.phase == "failed":
        return heading("Failed") + span(escape(job.failure), "bad")
    if job.is_running:
        bar = f'<div class="bar"><i style="width:{job.done:.0%};background:var(--mv-now)"></i></div>'
        is_checking = any(design.verification for design in job.found or ())
        return heading("Checking" if is_checking else "Searching", designs) + bar
    name = "Front" if job.phase == "ended" else "Cancelled"
    return heading(name, designs) + (_exactness(job.found) if job.found else "")


def _exactness(designs: Designs) -> str:
    """Return the verdict of the full model as given on them, as far as it was asked."""
    verifications = [design.verification for design in designs]
    if None in verifications:
        return span("Not solved from scratch.", "dim")
    impossible = [v.impossible for v in verifications if v and v.impossible]
    if impossible:
        return span(f"Not checked: {escape(impossible[0])}", "bad")
    difference = largest_difference(designs)
    text = f"Solved from scratch, the model as given has the same goals within {percent(difference)}."
    verdict = span(text, "bad" if 100 * difference > ALARMING else "dim")
    worst = most_truncated(designs)
    if worst is None or not is_large(worst[1]):
        return verdict
    number, gap = worst
    return f"{verdict} {span(escape(at_rates(f'the rates of design {number}', gap)), 'bad')}"

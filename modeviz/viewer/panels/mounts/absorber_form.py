"""Below the mount groups: an absorber to be added, and what one that was added weighs."""

from collections.abc import Callable
from dataclasses import replace
from html import escape

import numpy as np
import viser

from modeviz.errors import ModevizError, VehicleError
from modeviz.text.wording import number, significant, told_apart
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DIRECTIONS, MountRates
from modeviz.viewer.page.binding import Binding, Write, show_all
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.mounts.absorber_draft import (
    ALONG,
    AbsorberDraft,
    Point,
    Proposal,
    free_absorber_name,
    from_mm,
    in_mm,
    places,
)
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.absorbers import AddAbsorber, RemoveAbsorber, WeighAbsorber
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

ELSEWHERE = "Another place"

DECIMALS = 3

HEAVIEST = 1e5
"""kg: no absorber weighs more."""


class AbsorberForm:
    """Where an absorber is to sit, its mass and tuning, and the button that adds it."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls, folded up."""
        self._gui, self._session = gui, session
        self._write_back = WriteBack()
        labels = told_apart(carrying_bodies(session.vehicle))
        called = {name: label for label, name in labels.items()}
        self._first = next(iter(called))
        self.state: AbsorberDraft = AbsorberDraft()
        self._proposal: Proposal | None = None
        with gui.add_folder("Add an absorber", expand_by_default=False):
            body = gui.add_dropdown(
                "Body",
                tuple(labels),
                initial_value=called[self._first],
                hint="What the absorber sits on: a mass on a spring, tuned to a mode. First "
                "that with most of its energy, until it is chosen",
            )
            self._at = gui.add_dropdown(
                "At",
                self._offered(),
                initial_value=self._place_name(self.state),
                hint="A response point, a mount's end or an attachment of the body, or its centre of "
                "gravity; any other place by its coordinates. First the one that moves most",
            )
            place = gui.add_vector3(
                "x y z, mm",
                in_mm(self._position),
                step=10.0,
                hint="Along the vehicle's axes; on a flexible body near its nodes",
            )
            along = gui.add_dropdown(
                "Along",
                tuple(ALONG),
                initial_value=self._along(self.state),
                hint="In which directions of the vehicle it moves; along all others it goes along with "
                "its body",
            )
            kilograms = self._number(
                "Mass, kg",
                lambda proposal: proposal.mass or 0.0,
                lambda kg: self._put(replace(self.state, mass=kg)),
                "5 % of what moves there in the mode shown, until it is typed",
            )
            percent = self._number(
                "Mass, %",
                lambda proposal: 100 * (proposal.share or 0.0),
                self._take_share,
                "Of what moves there in the mode shown: more takes down a wider peak",
            )
            self._text = gui.add_html("")
            add = gui.add_button(
                "Add absorber", hint="Its spring is then a mount group like the others"
            )
        add.on_click(lambda event: self._add(event.client))
        self._bindings = [
            Binding(
                body,
                self,
                lambda _: called[self._body],
                lambda label: self._put(AbsorberDraft(labels[label])),
            ),
            Binding(self._at, self, self._place_name, self._take_place),
            Binding(
                place,
                self,
                lambda _: in_mm(self._position),
                lambda mm: self._put_at(from_mm(self._position, mm)),
                self._write_back,
                typed=True,
            ),
            Binding(
                along,
                self,
                self._along,
                lambda word: self._put(replace(self.state, directions=ALONG[word])),
            ),
            kilograms,
            percent,
        ]

    def show(self, solved: Solved) -> None:
        """Tunes the draft to the mode that is shown."""
        self._proposal = self.state.proposed(solved)
        self._follow()

    def _follow(self) -> None:
        assign(self._at, options=self._offered())
        show_all(self._bindings)
        if self._proposal is not None:
            assign(self._text, content=block(span(escape(self._words(self._proposal)), "dim")))

    def _words(self, proposal: Proposal) -> str:
        """What it would be tuned to, a sentence."""
        if proposal.share is None:
            return f"{proposal.mode} hardly moves this place along that; choose another."
        try:
            absorber = proposal.made(self._solved(), free_absorber_name(self._session.vehicle))
        except ModevizError as error:
            return str(error)
        moved = significant(float(f"{proposal.moved:.3g}"))
        return (
            f"In {proposal.mode} {moved} kg move there. Tuned to {number(absorber.frequency_hz, 2)} "
            f"Hz, {number(100 * absorber.damping_ratio, 1)} % of critical (Den Hartog)."
        )

    def _add(self, client: viser.ClientHandle | None) -> None:
        try:
            solved = self._solved()
            name = free_absorber_name(self._session.vehicle)
            self._session.do(AddAbsorber(self.state.proposed(solved).made(solved, name)))
            self._put(AbsorberDraft())
        except ModevizError as error:
            if client:
                refuse(client, str(error), is_passing=True)

    def _solved(self) -> Solved:
        if self._session.answer is None:
            raise ModevizError("nothing is solved yet: try again when the preparation is done")
        return self._session.answer

    def _put(self, draft: AbsorberDraft) -> None:
        self.state = draft
        if self._session.answer is not None:
            self._proposal = draft.proposed(self._session.answer)
        self._follow()

    def _take_place(self, name: str) -> None:
        found = places(self._session.vehicle, self._body).get(name)
        if found is not None:
            self._put_at(found)

    def _put_at(self, position: Point) -> None:
        """Puts it to a place of the body that is shown, which it no longer leaves."""
        self._put(replace(self.state, body=self._body, position=position))

    @property
    def _body(self) -> str:
        return self._proposal.body if self._proposal else self.state.body or self._first

    @property
    def _position(self) -> Point:
        """Where it is, m; before the first answer at the first place."""
        if self._proposal is not None:
            return self._proposal.position
        known = places(self._session.vehicle, self._body).values()
        return self.state.position or next(iter(known), (0.0, 0.0, 0.0))

    def _place_name(self, _: AbsorberDraft) -> str:
        known = places(self._session.vehicle, self._body)
        return next((name for name, place in known.items() if place == self._position), ELSEWHERE)

    def _take_share(self, percent: float) -> None:
        moved = self._proposal.moved if self._proposal else float("inf")
        if moved == float("inf"):
            raise VehicleError("the mode shown hardly moves this place along that; choose another")
        self._put(replace(self.state, mass=percent / 100 * moved))

    def _offered(self) -> tuple[str, ...]:
        return (*places(self._session.vehicle, self._body), ELSEWHERE)

    def _along(self, draft: AbsorberDraft) -> str:
        known = draft.directions or (self._proposal and self._proposal.directions)
        return next((word for word, along in ALONG.items() if along == known), next(iter(ALONG)))

    def _number(
        self, label: str, read: Callable[[Proposal], float], write: Write, hint: str
    ) -> Binding:
        """A box for a number of the proposal."""

        def shown(_: AbsorberDraft) -> float:
            return round(read(self._proposal), DECIMALS) if self._proposal else 0.0

        box = self._gui.add_number(label, shown(self.state), min=0.0, max=HEAVIEST, step=0.1, hint=hint)
        assign(box, precision=DECIMALS)
        return Binding(box, self, shown, write, self._write_back, typed=True)


class AbsorberDetails:
    """The mass of an absorber that was added, and the button that removes it."""

    def __init__(self, gui: viser.GuiApi, session: Session, group: MountGroup) -> None:
        """Builds them.

        Args:
            gui: where.
            session: in which it was added.
            group: its spring.
        """
        name = group.name

        def mass(state: State) -> float:
            absorber = state.design.alterations.absorber(name)
            return absorber.mass if absorber else 0.0

        box = gui.add_number(
            "Mass, kg",
            mass(session.state),
            min=0.0,
            max=HEAVIEST,
            step=0.1,
            hint=f"Of {name}; its rates go along, so that its frequency stays. No search changes it",
        )
        assign(box, precision=DECIMALS)
        self._text = gui.add_html("")
        remove = gui.add_button(
            "Remove absorber",
            hint="And what was said of its rates; sets keep it that were pinned with it",
        )
        remove.on_click(lambda _: session.do(RemoveAbsorber(name)))
        self.bindings: tuple[Binding[State], ...] = (
            Binding(
                box,
                session,
                mass,
                lambda kg: session.do(WeighAbsorber(name, kg)),
                WriteBack(),
                typed=True,
            ),
        )

    def show(self, mass: float, rates: MountRates) -> None:
        """Says how its mass moves on its spring, were its body still."""
        assign(self._text, content=block(span(f"On its spring {_motions(mass, rates)}", "dim")))


class GivenAbsorber:
    """What an absorber of the vehicle's file weighs, and how its mass moves on its spring."""

    bindings: tuple[Binding[State], ...] = ()
    """None: it is read."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Builds an empty line."""
        self._text = gui.add_html("")

    def show(self, mass: float, rates: MountRates) -> None:
        """Says so."""
        words = f"{significant(mass)} kg, as in the vehicle's file; on its spring "
        assign(self._text, content=block(span(words + _motions(mass, rates), "dim")))


def _motions(mass: float, rates: MountRates) -> str:
    """How a mass moves on springs along each direction that has one."""
    every = zip(DIRECTIONS, rates.as_tuple(), reversed(rates.damping()), strict=True)
    return "; ".join(_motion(mass, k, c, direction) for direction, k, c in every if k)


def _motion(mass: float, stiffness: float, damping: float, direction: str) -> str:
    """At which frequency, and with how much damping."""
    frequency_hz = np.sqrt(stiffness / mass) / (2 * np.pi)
    of_critical = damping / (2 * np.sqrt(stiffness * mass))
    return f"{number(frequency_hz, 2)} Hz {direction}, {number(100 * of_critical, 1)} % of critical"

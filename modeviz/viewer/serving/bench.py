"""A vehicle on the bench: made ready once for all its sessions, which its study remembers."""

import secrets
import threading
from collections.abc import Callable
from functools import cached_property, partial

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.compute.precedence import Precedence
from modeviz.journal.fingerprint import Fingerprint, fingerprint_of
from modeviz.journal.keys import digest_of
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.beginnings import Beginnings
from modeviz.viewer.session.design import known_sets
from modeviz.viewer.session.encoding.link import opening_of_link
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.preparations import Preparations
from modeviz.viewer.session.recorded import recorded
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State, first_state

Progress = Callable[[float], None]


class Bench:
    """What the sessions of a vehicle share."""

    def __init__(
        self,
        vehicle: Vehicle,
        rates: Rates,
        conditions: Conditions,
        link: str | None = None,
        study: StudyFile | None = None,
    ) -> None:
        """Prepares nothing yet.

        Args:
            vehicle: with the rates that all is compared with.
            rates: of a new session.
            conditions: of a new session.
            link: what a new session shows in their place, see `opening_of_link`.
            study: remembers sessions; without it they end with memory.

        Raises:
            ModevizError: the link is none, or the study cannot be read.
        """
        self.vehicle: Vehicle = vehicle
        self.rates: Rates = rates
        self.conditions: Conditions = conditions
        self.study: StudyFile | None = study
        self._link = link
        self._reviews: dict[str, SessionId] = study.reviews() if study else {}
        """Sessions by the digests of the keys that open them to visitors."""
        self._lock, self._reviews_lock = threading.Lock(), threading.Lock()
        self._prepared: Prepared | None = None
        self._told: list[Progress] = []
        first, sets = self.opening().state, known_sets(vehicle).values()
        self._beginnings = Beginnings(first.conditions, [first.design.rates, *sets])

    @property
    def title(self) -> str:
        """Of its pages."""
        return f"{self.vehicle.name} · modeviz"

    @property
    def is_prepared(self) -> bool:
        """Whether the vehicle is ready."""
        return self._prepared is not None

    @cached_property
    def fingerprint(self) -> Fingerprint:
        """Of the vehicle."""
        return fingerprint_of(self.vehicle)

    def opening(self, link: str | None = None) -> Opening:
        """Return what a new session opens with.

        Args:
            link: what somebody sent; see `opening_of_link`.

        Raises:
            ModevizError: the link is none.
        """
        usual, shown = self._usual(), link or self._link
        if shown is None:
            return Opening(usual)
        return opening_of_link(shown, usual, self.vehicle, self.fingerprint.digest)

    def left(self, session: SessionId) -> Opening | None:
        """Return a session as it was left; None if it is a new one.

        Raises:
            ModevizError: the study cannot be read.
        """
        if self.study is None:
            return None
        return recorded(self.study, session, self._usual(), self.vehicle, self.fingerprint.digest)

    def share(self, session: SessionId, author: str) -> str:
        """Return the key of a new review of a session, which somebody shares."""
        key = secrets.token_urlsafe(16)
        with self._reviews_lock:
            self._reviews = {**self._reviews, digest_of(key): session}
        if self.study:
            self.study.share(session, digest_of(key), author)
        return key

    def end_reviews(self, session: SessionId) -> None:
        """Has the keys of a session's reviews open nothing any more."""
        with self._reviews_lock:
            self._reviews = {key: shown for key, shown in self._reviews.items() if shown != session}
        if self.study:
            self.study.end_reviews(session)

    def is_shared(self, session: SessionId) -> bool:
        """Return whether some review's key opens a session."""
        return session in self._reviews.values()

    def reviewed(self, key: str) -> SessionId | None:
        """Return the session that the key of a review opens, if any."""
        return self._reviews.get(digest_of(key))

    def shared(self, precedence: Precedence) -> Shared:
        """Return what a session has in common with others: as long as nothing is altered, all.

        Args:
            precedence: of all sessions that share the processors.
        """
        return Shared(Preparations(self.vehicle, self.prepared), self._beginnings, precedence)

    def prepared(self, progress: Progress | None = None) -> Prepared:
        """Return the vehicle made ready; who asks while that is being done waits for it.

        Args:
            progress: told the fraction that is done; what it raises ends that, unless the vehicle is
                being made ready for somebody else: then it is told no more.

        Raises:
            ModevizError: it cannot be prepared.
        """
        if progress:
            self._told.append(progress)
        try:
            with self._lock:
                if self._prepared is None:
                    self._prepared = prepare(self.vehicle, progress=partial(self._tell, progress))
                return self._prepared
        finally:
            self._tell_no_more(progress)

    def _usual(self) -> State:
        return first_state(self.vehicle, self.rates, self.conditions)

    def _tell(self, own: Progress | None, fraction: float) -> None:
        """Tells everybody who waits; `own` is told of whom the thread is."""
        for progress in tuple(self._told):
            try:
                progress(fraction)
            except Exception:
                if progress is own:
                    raise
                self._tell_no_more(progress)

    def _tell_no_more(self, progress: Progress | None) -> None:
        if progress and progress in self._told:
            self._told.remove(progress)

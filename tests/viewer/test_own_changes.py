"""Whose a change is outlives the server: who comes again undoes his own changes and no others."""

import shutil
from contextlib import contextmanager
from urllib.parse import urlencode

import viser
from guests import heard_until
from serving_cabin import key_of, page_at, serving, way
from visitors import update, wait_until

from modeviz.journal.keys import digest_of
from modeviz.viewer.panels.mounts.history_row import UNDO

ANNA = urlencode({"visitor": "annas-key-of-26-characters", "name": "Anna"})
OWNER = urlencode({"visitor": "owners-key-of-26-characters", "name": "Olga"})


class Reviewed:
    """A session with a page of its owner's and one of a guest's."""

    def __init__(self, directory, name, owner, anna):
        wait_until(lambda: directory.sessions.get(("cabin", name)))
        session = directory.sessions.open["cabin", name]
        wait_until(lambda: session.app.session.answer, 60)
        wait_until(lambda: len(session.server.visitors.there) == 2)
        self.app, self.visitors = session.app, session.server.visitors
        self.owner, self.anna = owner, anna
        handles = session.server.gui._gui_input_handle_from_uuid.values()
        self.sliders = [each for each in handles if isinstance(each, viser.GuiSliderHandle)]

    @property
    def design(self):
        return self.app.session.state.design

    def give_control(self, to):
        by, taker = ({v.name: v for v in self.visitors.there}[name] for name in ("Olga", to))
        page = next(i for i in range(99) if self.visitors.of_page(i) == by)
        assert self.visitors.hand_over(page, taker.number)

    def move(self, page, number):
        before, slider = self.design, self.sliders[number]
        page.send(update(slider, slider.value + 20))
        wait_until(lambda: self.design != before)
        return before

    def undo(self, page):
        page.send(update(self.app.screen.controls.history._buttons, UNDO))

    def told(self, page, words):
        assert heard_until(page, lambda told: [each for each in told if words in str(each)])


@contextmanager
def reviewed(front, directory, path, link):
    with page_at(front, f"{path}&{OWNER}") as owner, page_at(front, f"{link}&{ANNA}") as anna:
        yield Reviewed(directory, digest_of(key_of(path)), owner, anna)


def test_owner_and_guest_undo_their_own_changes_after_the_server_was_killed(tmp_path):
    file, killed = tmp_path / "cabin.modeviz", tmp_path / "killed.modeviz"
    with serving(file) as (front, directory):
        (bench,) = directory.benches.values()
        path = way(front)
        name = digest_of(key_of(path))
        bench.study.begin(name)
        link = f"/?review={bench.share(name, 'Olga')}"
        with reviewed(front, directory, path, link) as here:
            here.move(here.owner, 0)
            here.give_control("Anna")
            between = here.move(here.anna, 1)
            after = here.design
            assert here.app.keeping._recorder.flush(20)
            for ending in ("", "-wal"):  # what is on the disk as the server is killed
                shutil.copy(f"{file}{ending}", f"{killed}{ending}")
    assert b"annas-key-of-26" not in killed.read_bytes()
    with serving(killed) as (front, directory), reviewed(front, directory, path, link) as here:
        assert here.design == after
        here.undo(here.owner)
        here.told(here.owner, "A change of Anna")
        here.give_control("Anna")
        here.undo(here.anna)
        wait_until(lambda: here.design == between)
        here.undo(here.anna)
        here.told(here.anna, "is Olga's, so only Olga can")
        assert here.design == between
        here.give_control("Olga")
        here.undo(here.owner)
        wait_until(lambda: here.design != between)
        assert not here.app.session.can_undo

import threading

import pytest

from modeviz.compute.cancel import CancelledError, CancelToken


def test_it_lets_a_computation_run():
    token = CancelToken()
    token.check()
    assert not token.is_cancelled


def test_cancelled_it_ends_it():
    token = CancelToken()
    token.cancel()
    assert token.is_cancelled
    with pytest.raises(CancelledError):
        token.check()


@pytest.mark.parametrize("release", ["resume", "cancel"])
def test_held_it_waits_until_it_may_go_on_or_has_to_end(release):
    token, ends = CancelToken(), []
    token.pause()

    def compute():
        try:
            token.check()
            ends.append("resume")
        except CancelledError:
            ends.append("cancel")

    thread = threading.Thread(target=compute)
    thread.start()
    thread.join(0.1)
    assert not ends
    getattr(token, release)()
    thread.join(60)
    assert ends == [release]

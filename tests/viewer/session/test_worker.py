import threading
import time

from modeviz.viewer.session.worker import Worker


def test_a_burst_ends_with_its_last_job_and_skips_what_was_overtaken():
    done, started, go_on = [], threading.Event(), threading.Event()

    def work(job):
        started.set()
        go_on.wait(5)
        done.append(job)

    worker = Worker(work, fail=lambda e: None)
    worker.submit(0)
    started.wait(5)
    for job in range(1, 50):
        worker.submit(job)
    go_on.set()
    assert worker.wait(5)
    assert done == [0, 49]
    worker.close()


def test_nobody_waits_for_what_a_closed_one_leaves_undone():
    started, go_on = threading.Event(), threading.Event()

    def work(_):
        started.set()
        go_on.wait(20)

    worker = Worker(work, fail=lambda e: None)
    worker.submit("first")
    started.wait(5)
    worker.submit("left undone")
    threading.Timer(0.1, go_on.set).start()
    worker.close()
    begin = time.monotonic()
    assert not worker.wait(20)
    assert time.monotonic() - begin < 10


def test_jobs_never_overlap():
    running, most = 0, 0
    lock = threading.Lock()

    def work(_):
        nonlocal running, most
        with lock:
            running += 1
            most = max(most, running)
        with lock:
            running -= 1

    worker = Worker(work, fail=lambda e: None)
    threads = [
        threading.Thread(target=lambda: [worker.submit(i) for i in range(200)]) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert worker.wait(5)
    assert most == 1
    worker.close()


def test_a_job_that_fails_is_told_and_the_next_is_done():
    done, errors = [], []

    def work(job):
        if job == "bad":
            raise ValueError("bad job")
        done.append(job)

    worker = Worker(work, errors.append)
    worker.submit("bad")
    assert worker.wait(5)
    worker.submit("good")
    assert worker.wait(5)
    assert [str(e) for e in errors] == ["bad job"]
    assert done == ["good"]
    worker.close()
    assert not worker._thread.is_alive()


def test_a_job_that_hangs_is_left_behind_though_telling_of_it_goes_wrong():
    has_begun, go_on = threading.Event(), threading.Event()
    done, failed = [], []

    def work(job):
        if job == "hangs":
            has_begun.set()
            go_on.wait(20)
        else:
            done.append(job)

    def leave(*_):
        raise RuntimeError("not told")

    worker = Worker(work, failed.append, 0.2, leave)
    worker.submit("hangs")
    assert has_begun.wait(5)
    worker.submit("next")
    try:
        assert worker.wait(5)
        assert done == ["next"]
        assert [str(error) for error in failed] == ["not told"]
    finally:
        go_on.set()
        worker.close()


def test_a_worker_goes_on_where_telling_of_a_failure_goes_wrong(monkeypatch):
    done, said = [], []
    monkeypatch.setattr(threading, "excepthook", lambda what: said.append(str(what.exc_value)))

    def work(job):
        if job == "bad":
            raise ValueError("bad job")
        done.append(job)

    def fail(error):
        raise RuntimeError(f"not told: {error}")

    worker = Worker(work, fail)
    worker.submit("bad")
    assert worker.wait(5)
    worker.submit("good")
    assert worker.wait(5)
    assert said == ["not told: bad job"]
    assert done == ["good"]
    worker.close()

import json
import logging
import sys

from modeviz.text.log import JsonFormatter, LineFormatter, redacted


def record(text, **fields):
    made = logging.LogRecord("modeviz", logging.WARNING, "file", 1, "%s", (text,), None)
    vars(made).update(fields)
    return made


def test_a_record_is_one_json_object_on_one_line():
    line = JsonFormatter().format(record("two\nlines", event="mistake", id="abc123", client=None))
    assert "\n" not in line
    read = json.loads(line)
    assert read.pop("time").endswith("+00:00")
    assert read == {"level": "warning", "event": "mistake", "id": "abc123", "message": "two\nlines"}


def test_nothing_that_opens_a_session_is_written():
    secret = "Zm9vYmFyYmF6cXV4MTIzNA"
    for text in (
        f"GET /?token={secret}&session={secret} HTTP/1.1",
        f"Cookie: modeviz8080={secret}; HttpOnly",
        f"{{'token': '{secret}', 'review': \"{secret}\"}}",
        f"Session: {secret}",
        f"modeviz8080session0={secret}; Max-Age=3",
    ):
        assert secret not in redacted(text)
        assert secret not in LineFormatter("%(message)s").format(record(text))
        assert secret not in JsonFormatter().format(record(text))
    assert redacted("a session was opened: 3 pages") == "a session was opened: 3 pages"


def test_what_went_wrong_is_in_the_object_without_secrets():
    try:
        raise ValueError("GET /?token=Zm9vYmFyYmF6")
    except ValueError:
        made = logging.LogRecord("modeviz", logging.ERROR, "file", 1, "not told", (), sys.exc_info())
    read = json.loads(JsonFormatter().format(made))
    assert read["message"].startswith("not told\nTraceback")
    assert "ValueError: GET /?token=…" in read["message"]

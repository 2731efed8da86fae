"""What a page says of who looks at it when it opens its websocket: words of strangers."""

import re
import secrets
import unicodedata
from dataclasses import dataclass
from urllib.parse import parse_qsl, urlsplit

from websockets.http11 import Request

KEY, NAME, REVIEW = "visitor", "name", "review"
"""Parameters of a websocket's address."""

LONGEST_NAME = 30

BESIDE_LETTERS = " _.,'’()&+/-"
"""That a name may have: nothing of markup, and nothing that turns the direction of writing."""

MOST_MARKS = 2
"""Accents and vowel signs on one letter; more would hang into the lines around."""


@dataclass(frozen=True)
class Introduction:
    """Who a page says is looking at it."""

    key: str
    """By which the browser is known when it comes again, and which nobody else is told."""
    name: str
    """See `person_name`; "" if it says none."""


def introduction(request: Request) -> Introduction:
    """Return what the request of a page's websocket says; what is no key becomes a new one."""
    query = dict(parse_qsl(urlsplit(request.path).query))
    key = query.get(KEY, "")
    is_key = re.fullmatch(r"[\w-]{16,64}", key, re.ASCII)
    return Introduction(key if is_key else secrets.token_urlsafe(), person_name(query.get(NAME, "")))


def is_review(request: Request) -> bool:
    """Whether the request of a page's websocket has come by the link of a review."""
    return REVIEW in dict(parse_qsl(urlsplit(request.path).query, keep_blank_values=True))


def person_name(text: str) -> str:
    """Return a name that may stand on other people's pages: of letters, short, on one line; else ""."""
    kept, n_marks = "", 0
    for letter in " ".join(unicodedata.normalize("NFKC", text[: 4 * LONGEST_NAME]).split()):
        is_mark = unicodedata.category(letter).startswith("M")
        n_marks = n_marks + 1 if is_mark else 0
        if n_marks <= MOST_MARKS and (is_mark or letter.isalnum() or letter in BESIDE_LETTERS):
            kept += letter
    return " ".join(kept[:LONGEST_NAME].split())

"""Cookies: what a browser brings, and how it is asked to keep one."""

from websockets.http11 import Request, Response

STRICT = "SameSite=Strict"
FRAMED = "SameSite=None; Secure; Partitioned"
"""How a cookie is kept in a frame of a page of another name: for that page alone. Browsers take
127.0.0.1 and localhost for secure, but no other address without TLS."""


def cookies(request: Request) -> dict[str, str]:
    """Return the cookies that come with a request, by name."""
    pairs = (pair for line in request.headers.get_all("Cookie") for pair in line.split(";"))
    return {name: value for name, _, value in (pair.strip().partition("=") for pair in pairs)}


def give_cookie(
    response: Response, name: str, value: str, life: float, is_secure: bool, is_framed: bool
) -> None:
    """Has a browser keep a cookie that its scripts do not see.

    Args:
        response: with which it is given.
        name: of the cookie; those of all ports of a host share their names.
        value: of letters that need no quotes.
        life: for which it is kept, s.
        is_secure: whether it came by TLS, and then comes by nothing else.
        is_framed: whether pages of other sites may show ours in a frame.
    """
    cookie = f"{name}={value}; Max-Age={life:.0f}; HttpOnly"
    alone = f"{STRICT}; Secure" if is_secure else STRICT
    for kept in (alone, FRAMED) if is_framed else (alone,):
        response.headers["Set-Cookie"] = f"{cookie}; {kept}"

"""Names, frames and a path that a server has from elsewhere."""

import pytest

from modeviz.errors import ModevizError
from modeviz.viewer.page.doors.surroundings import surroundings


@pytest.mark.parametrize(
    ("option", "given"),
    [
        ("--public-name", {"public_names": ("http://tool/",)}),
        ("--allow-frame", {"frames": ("wiki.example.com",)}),
        ("--allow-frame", {"frames": ("*",)}),
        ("--allow-frame", {"frames": ("https://*.example.com",)}),
        ("--allow-frame", {"frames": ("https://wiki.example.com/page",)}),
        ("--allow-frame", {"frames": ("https://a.example.com https://b.example.com",)}),
        ("--allow-frame", {"frames": ("https://a.example.com; script-src *",)}),
        ("--allow-frame", {"frames": ("javascript://wiki",)}),
        ("--allow-frame", {"frames": ("null",)}),
        ("--path-prefix", {"prefix": "bench"}),
        ("--path-prefix", {"prefix": "/a b"}),
        ("--path-prefix", {"prefix": "//evil.example"}),
        ("--path-prefix", {"prefix": "/a/../b"}),
        ("--path-prefix", {"prefix": "/a?b"}),
    ],
)
def test_what_is_no_such_thing_is_refused(option, given):
    with pytest.raises(ModevizError, match=f"^{option}: found .*, expected .* such as"):
        surroundings(**given)


def test_origins_and_paths_are_taken_as_people_write_them():
    around = surroundings(frames=("https://Wiki.example.com/", "http://[::1]:8888"), prefix="/a/b/")
    assert around.frames == ("https://wiki.example.com", "http://[::1]:8888")
    assert around.prefix == "/a/b"


@pytest.mark.parametrize(
    ("path", "local"),
    [
        ("/bench/", "/"),
        ("/bench/?a=b", "/?a=b"),
        ("/bench/index.html", "/index.html"),
        ("/", "/"),  # a proxy has taken it off
        ("/benchmark", "/benchmark"),
        ("/bench", None),
        ("/bench?a=/b", None),
    ],
)
def test_a_prefix_is_taken_off_or_was(path, local):
    assert surroundings(prefix="/bench").local_path(path) == local
    assert surroundings().local_path(path) == path

"""What can be written, by the names of files."""

import re
from dataclasses import replace
from pathlib import Path

import pytest
from mounted_cabin import mounted_cabin

from modeviz.errors import ModevizError
from modeviz.export.catalogue import body_words, contents, writer
from modeviz.export.writers import DECKS, WHOLE

PAGE = Path(__file__).parents[2].joinpath("docs/export.md").read_text("utf-8")


def named(*names):
    """The cabin with bodies of other names, alike but for these."""
    vehicle = mounted_cabin()
    alone = replace(vehicle, connections=(), mount_groups=(), rate_sets={}, response_points=(),
                    wheel_loads=())  # fmt: skip
    return replace(alone, bodies=tuple(replace(vehicle.bodies[0], name=name) for name in names))


def test_the_page_of_exports_lists_every_content_with_its_formats():
    rows = re.findall(r"^\| `([\w-]+)` \| ([^|]+) \|", PAGE, re.MULTILINE)
    listed = {word: set(re.findall(r"`(\.\w+)`", formats)) for word, formats in rows}
    assert listed == {word: set(formats) - set(DECKS[1:]) for word, formats in WHOLE.items()}


@pytest.mark.parametrize(
    ("name", "content", "ending"),
    [
        ("modes.unv", "modes", ".unv"),
        ("Modes.UNV", "modes", ".unv"),
        ("run 3 modes.unv", "modes", ".unv"),
        ("optimised_modes.unv", "modes", ".unv"),
        ("complex-modes.unv", "complex-modes", ".unv"),
        ("Complex Modes.uff", "complex-modes", ".uff"),
        ("variant.2-psd.csv", "psd", ".csv"),
    ],
)
def test_the_last_words_of_a_name_say_what_a_file_has(name, content, ending):
    vehicle = mounted_cabin()
    assert writer(Path(name), vehicle) is contents(vehicle)[content][ending]


@pytest.mark.parametrize("name", ["modes2.unv", "supermodes.unv", "modes-run3.unv", ".unv", "modes"])
def test_other_names_say_nothing(name):
    with pytest.raises(ModevizError, match="expected"):
        writer(Path(name), mounted_cabin())


def test_every_body_has_words_of_its_own():
    words = body_words(named("Front end", "front-end", "modes", "Bänk", "底盘", "!"))
    assert words == {
        "Front end": "front-end",
        "front-end": "front-end-2",
        "modes": "modes-2",
        "Bänk": "bänk",
        "底盘": "底盘",
        "!": "body",
    }

"""What a notebook's cell holds of a page: the live bench where it is in reach, and else a still of it.

Whoever shows the notebook without its scripts, or on another day, shows the still.
"""

import gzip
import json
import secrets
from base64 import b64encode
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from urllib.parse import urlsplit

from modeviz.study.notebook import block

LARGEST_OFFLINE = 3_000_000
"""Bytes of what plays without a server, compressed; they take a third more in the notebook's file."""

N_STILLS = 2
"""A notebook's file has one in the HTML, and one beside it for what shows none, such as PDF."""

RUN_IT = "A still picture: run the cell, in a notebook that is trusted, to have the live bench here."


@dataclass(frozen=True)
class Cell:
    """A page and a still of it, for a cell."""

    name: str
    """Of the vehicle."""
    link: str
    """What opens the page on the machine of the notebook's kernel, with its token."""
    through: str
    """The address at which browsers reach it, with "{port}"; "": the cell finds out."""
    prefix: str
    """The path of the notebook's server as its kernel knows it; "" where it does not."""
    height: int
    """Pixels."""
    moving: str
    """What the still shows."""
    png: bytes
    """The still; empty if there is none yet."""
    page: bytes
    """An HTML file that needs no server; empty if it is not wanted."""

    def html(self) -> str:
        """Return the HTML of the cell."""
        number, packed = f"modeviz-{secrets.token_hex(6)}", self._packed()
        url = urlsplit(self.link)
        given = {
            "port": url.port,
            "query": f"?{url.query}",
            "through": self.through,
            "prefix": self.prefix,
            "height": self.height,
            "offline": packed,
        }
        script = files("modeviz.study").joinpath("cell.js").read_text("utf-8").rstrip()
        arguments = json.dumps(given).replace("</", "<\\/")
        return (
            f'<div id="{number}">{block(self.name, self._still())}'
            f'<div class="modeviz"><p class="mv-said">{RUN_IT}</p>'
            f'<p class="mv-open"><a href="{escape(self.link)}" target="_blank">Open it in a tab of its '
            f"own</a></p><p>{self._size(packed)}</p></div>"
            f'<script>({script})("{number}", {arguments});</script></div>'
        )

    def framed_html(self) -> str:
        """Return the same in a frame, for a notebook that runs scripts nowhere else."""
        page = f'<body style="margin:0">{self.html()}</body>'
        return (
            f'<iframe title="modeviz" srcdoc="{escape(page)}" width="100%" height="{self.height + 70}" '
            'style="border:0" allow="fullscreen; clipboard-write"></iframe>'
        )

    def _still(self) -> str:
        if not self.png:
            return '<figure class="mv-still"></figure>'
        return (
            f'<figure class="mv-still"><img alt="{escape(self.moving)}" style="max-width:100%" '
            f'src="data:image/png;base64,{b64encode(self.png).decode()}">'
            f"<figcaption>{escape(self.moving)}</figcaption></figure>"
        )

    def _packed(self) -> str:
        packed = gzip.compress(self.page, 6, mtime=0) if self.page else b""
        return b64encode(packed).decode() if len(packed) <= LARGEST_OFFLINE else ""

    def _size(self, packed: str) -> str:
        """What the cell adds to the notebook's file."""
        megabytes = (len(packed) + N_STILLS * 4 / 3 * len(self.png)) / 1e6
        plays = "; what plays without a server is too large for it" if self.page and not packed else ""
        return f"Saved with the notebook: {megabytes:.1f} MB{plays}."

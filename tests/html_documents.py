"""Reading HTML as a program does: what it holds, and whether it is well-formed."""

from html.parser import HTMLParser

VOID = {"meta", "img", "br"}


class Document(HTMLParser):
    """The tables, addresses, tags and words of a document; a tag out of place is an error."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tables: dict[str, list[list[str]]] = {}
        """The rows of each table, by the heading before it."""
        self.headings: list[str] = []
        self.addresses: list[str] = []
        self.tags: set[str] = set()
        self.words = ""
        self._open: list[str] = []
        self.feed(text)
        self.close()
        assert not self._open

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.addresses += [v for k, v in attributes if k in ("src", "href", "action", "xlink:href")]
        if tag not in VOID:
            self._open.append(tag)
        if tag in ("h1", "h2", "h3"):
            self.headings.append("")
        elif tag == "table":
            self.tables[self.headings[-1]] = []
        elif tag == "tr":
            self._rows.append([])
        elif tag in ("td", "th"):
            self._rows[-1].append("")

    def handle_startendtag(self, tag, attributes):
        self.tags.add(tag)

    def handle_endtag(self, tag):
        assert self._open.pop() == tag

    def handle_data(self, data):
        self.words += data
        if self._open and self._open[-1] in ("h1", "h2", "h3"):
            self.headings[-1] += data
        if "td" in self._open or "th" in self._open:
            self._rows[-1][-1] += data

    @property
    def _rows(self):
        return self.tables[self.headings[-1]]


def value(cell: str) -> float:
    """The number in a cell."""
    return float(cell.replace("−", "-").removesuffix(" %").removeprefix("~"))

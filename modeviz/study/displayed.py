"""What every result of a study has in common: it prints, and shows itself in a notebook."""

from abc import ABC, abstractmethod

from modeviz.report.records import Record


class Displayed(ABC):
    """A result that prints as a table, shows itself in a notebook and becomes plain values."""

    @abstractmethod
    def table(self) -> str:
        """Return it as text, as the command line prints it."""

    @abstractmethod
    def to_dict(self) -> Record:
        """Return it as plain values, with the keys that the command line prints with `--json`."""

    @abstractmethod
    def _repr_html_(self) -> str:
        """Return it as HTML, for a notebook."""

    def __repr__(self) -> str:
        return self.table()

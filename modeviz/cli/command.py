"""What a command of the program is: its name, what can be asked of it, and what it does."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields
from typing import Any, Generic, TypeVar

from modeviz.errors import ModevizError

Options = TypeVar("Options")


@dataclass(frozen=True)
class Command(Generic[Options]):
    """A command, and how its options are read."""

    name: str
    help: str
    """What it does, as the list of commands says it."""
    options: type[Options]
    """A frozen dataclass; what is not given is as it says."""
    add_options: Callable[[ArgumentParser], None]
    """Lets a parser read fields of that, by their names."""
    run: Callable[[Options], None]

    def asked(self, given: Namespace) -> Options:
        """Return the options that a parser was given.

        Raises:
            ModevizError: one is out of its range.
        """
        named = {field.name for field in fields(self.options)}  # type: ignore[arg-type]
        with of_options():
            return self.options(**{n: _frozen(v) for n, v in vars(given).items() if n in named})


@dataclass(frozen=True)
class CommandGroup:
    """Commands that stand behind a word of their own: `modeviz study log`."""

    name: str
    help: str
    """What they are about, as the list of commands says it."""
    commands: tuple[Command[Any], ...]


@contextmanager
def of_options() -> Iterator[None]:
    """Names what is wrong inside the block as an option is written: "--seed" for "seed".

    Raises:
        ModevizError: something inside raised one.
    """
    try:
        yield
    except ModevizError as error:
        raise ModevizError(f"--{error}") from None


def _frozen(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value

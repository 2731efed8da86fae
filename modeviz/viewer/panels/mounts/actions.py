"""What buttons do to rates: back to the set compared with, and locks."""

from dataclasses import replace

from modeviz.viewer.session import Session
from modeviz.viewer.state import compared_rates


def reset(session: Session, *groups: str) -> None:
    """Sets groups back to the rates compared with; locked ones stay."""
    compared = compared_rates(session.vehicle, session.state)
    session.set_rates({group: compared[group] for group in groups if group})


def reset_rate(session: Session, group: str, field: str) -> None:
    """Sets one rate back, and no other, even of a linked group."""
    compared = compared_rates(session.vehicle, session.state)
    back = {field: getattr(compared[group], field)}
    session.set_rates({group: replace(session.state.rates[group], **back)})


def toggle_lock(session: Session, group: str, field: str) -> None:
    """Locks a rate, or lets it move again."""
    session.change(locked=session.state.locked ^ {(group, field)})

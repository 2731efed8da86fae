"""What controls do to mount groups: back to the set compared with, loss factors, links and locks."""

from dataclasses import replace

from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State, compared_rates


def reset(session: Session, *groups: str) -> None:
    """Sets groups back to the rates compared with; locked ones stay."""

    def back(state: State) -> State:
        compared = compared_rates(session.vehicle, state)
        return state.with_rates({group: compared[group] for group in groups if group})

    session.update(back)


def reset_rate(session: Session, group: str, field: str) -> None:
    """Sets one rate back, and no other, even of a linked group."""

    def back(state: State) -> State:
        compared = getattr(compared_rates(session.vehicle, state)[group], field)
        return state.with_rates({group: replace(state.rates[group], **{field: compared})})

    session.update(back)


def damp(session: Session, group: str, loss_factor: float) -> None:
    """Gives a group another loss factor, and selects it."""

    def damped(state: State) -> State:
        rates = replace(state.rates[group], loss_factor=loss_factor)
        plain = session.vehicle.mount_group(group).plain(rates)
        return replace(state, rates={**state.rates, group: plain}, group=group)

    session.update(damped, ("loss factor", group))


def link(session: Session, group: str, linked: bool) -> None:
    """Keeps the ratios of a group's rates from now on, or no longer."""

    def changed(state: State) -> State:
        others = state.linked - {group}
        return replace(state, linked=others | {group} if linked else others)

    session.update(changed)


def toggle_lock(session: Session, group: str, field: str) -> None:
    """Locks a rate, or lets it move again."""
    session.update(lambda state: replace(state, locked=state.locked ^ {(group, field)}))

"""What of the ways to look at a design fits a vehicle."""

from collections.abc import Mapping
from dataclasses import replace

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError, quoted
from modeviz.ride.excitation import known_part
from modeviz.units import UNITS, QuantityName
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.curves import known_curves
from modeviz.viewer.session.design import rate_sets
from modeviz.viewer.session.encoding.remarks import Remarks
from modeviz.viewer.session.movement import n_free_modes
from modeviz.viewer.session.rigid_look import RigidLook
from modeviz.viewer.session.state import (
    ChartCurve,
    Charts,
    EngineLook,
    Look,
    Motion,
    ResponseCurve,
    State,
)

FASTEST = 1e3
"""m/s on a road, and revolutions per second of an engine."""


def fitted_looks(state: State, usual: State, vehicle: Vehicle, remarks: Remarks) -> State:
    """Return a state, whose design fits a vehicle, looking at what there is.

    Args:
        state: that is asked for.
        usual: the first one of the vehicle, for what there is not.
        vehicle: with its absorbers.
        remarks: told of what does not fit.
    """
    sets, groups = rate_sets(vehicle, state.design), vehicle.rates
    return replace(
        state,
        conditions=_conditions(state.conditions, usual.conditions, vehicle, remarks),
        motion=_motion(state.motion, usual.motion, vehicle, remarks),
        charts=replace(
            _charts(state.charts, usual.charts, vehicle, remarks),
            overlaid=frozenset(remarks.some("set", sorted(state.charts.overlaid), sets)),
        ),
        look=_look(state.look, vehicle, remarks),
        rigid=_rigid(state.rigid, usual.rigid, vehicle, remarks),
        engine=_engine(state.engine, usual.engine, vehicle, remarks),
        against=remarks.one("set", state.against, sets, usual.against),
        group=state.group and remarks.one("mount group", state.group, groups, usual=""),
        units={**usual.units, **_units(state.units, usual.units, remarks)},
    )


def _conditions(asked: Conditions, usual: Conditions, vehicle: Vehicle, remarks: Remarks) -> Conditions:
    """A road, or other random load, that is known at that speed."""
    speed = remarks.within("speed, m/s", asked.speed, 0.0, max(FASTEST, usual.speed))
    try:
        load = vehicle.random_load(asked.road)
        known_part(load, vehicle.frequency_hz, speed)
    except ModevizError as error:
        remarks.say(error)
        return usual
    if not vehicle.is_shaken_by(load) and asked.road != usual.road:
        remarks.say(f"road {asked.road!r} does not shake the vehicle")
        return usual
    return replace(asked, speed=speed)


def _motion(asked: Motion, usual: Motion, vehicle: Vehicle, remarks: Remarks) -> Motion:
    bodies = [body.name for body in carrying_bodies(vehicle)]
    cases = [case.name for case in vehicle.static_cases]
    component = remarks.one("body", asked.component, bodies, usual.component)
    last = max(usual.component_mode, *(n_free_modes(vehicle, body) - 1 for body in bodies))
    known = remarks.some("mount group", asked.mode_rates, vehicle.rates)
    return replace(
        asked,
        mode_rates={group: asked.mode_rates[group] for group in known},
        operating_hz=_in_band("frequency of the shape", asked.operating_hz, vehicle, remarks),
        component=component,
        component_mode=int(remarks.within("own mode", asked.component_mode, 0, last)),
        load_case=remarks.one("load case", asked.load_case, cases, usual.load_case),
    )


def _charts(asked: Charts, usual: Charts, vehicle: Vehicle, remarks: Remarks) -> Charts:
    loads = [load.name for load in vehicle.swept_loads]
    roads = [load for load in vehicle.offered_loads if not (isinstance(load, Road) and load.is_even)]
    curves, wanted = usual.curves, asked.curves
    if len(wanted) != len(curves):
        remarks.say(f"found {len(wanted)} charts, expected {len(curves)}")
        wanted = (*wanted, *curves[len(wanted) :])[: len(curves)]
    pairs = zip(wanted, curves, strict=True)
    path = _curve(asked.path_curve, usual.path_curve, vehicle, remarks)
    return replace(
        asked,
        load=remarks.one("load", asked.load, ["", *loads] if roads else loads or [""], usual.load),
        curves=tuple(_curve(curve, own, vehicle, remarks) for curve, own in pairs),
        cursor_hz=_in_band("cursor", asked.cursor_hz, vehicle, remarks),
        path_curve=path if isinstance(path, ResponseCurve) else usual.path_curve,
        rubber_direction=remarks.one(
            "direction", asked.rubber_direction, DIRECTIONS, usual.rubber_direction
        ),
    )


def _curve(asked: ChartCurve, usual: ChartCurve, vehicle: Vehicle, remarks: Remarks) -> ChartCurve:
    if asked == usual or asked in known_curves(vehicle):
        return asked
    if isinstance(asked, ResponseCurve):
        which = f"response point {asked.point}, {quoted(asked.direction)}"
    else:
        which = f"mount {quoted(asked.mount)}, {quoted(asked.motion)}"
    remarks.say(f"there is no curve of {which}")
    return usual


def _units(
    asked: Mapping[QuantityName, str], usual: Mapping[QuantityName, str], remarks: Remarks
) -> dict[QuantityName, str]:
    return {
        quantity: remarks.one(f"unit of {quantity}", unit, UNITS[quantity], usual[quantity])
        for quantity, unit in asked.items()
    }


def _in_band(what: str, frequency_hz: float, vehicle: Vehicle, remarks: Remarks) -> float:
    return remarks.within(f"{what}, Hz", frequency_hz, 0.0, vehicle.highest_frequency)


def _look(asked: Look, vehicle: Vehicle, remarks: Remarks) -> Look:
    bodies = [body.name for body in vehicle.bodies]
    return replace(asked, hidden=frozenset(remarks.some("body", sorted(asked.hidden), bodies)))


def _rigid(asked: RigidLook, usual: RigidLook, vehicle: Vehicle, remarks: Remarks) -> RigidLook:
    bodies = [body.name for body in carrying_bodies(vehicle)]
    return replace(asked, body=remarks.one("body", asked.body, bodies, usual.body))


def _engine(asked: EngineLook, usual: EngineLook, vehicle: Vehicle, remarks: Remarks) -> EngineLook:
    engines = [engine.name for engine in vehicle.engines]
    return EngineLook(
        remarks.one("engine", asked.engine, engines or [""], usual.engine),
        _curve(asked.curve, usual.curve, vehicle, remarks),
        remarks.within("speed of the engine, 1/s", asked.speed_hz, 0.0, FASTEST),
    )

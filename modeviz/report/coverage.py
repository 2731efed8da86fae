"""Words for the part of a vehicle's band that an answer is of."""

from modeviz.analysis.results import Results
from modeviz.units import factor
from modeviz.vehicle.iso_8608 import DESCRIBED, FLAT_BELOW
from modeviz.vehicle.loads import Road


def band_text(results: Results) -> str:
    """Over what RMS values are taken, from the first line on: "0.1 to 40 Hz"."""
    low, high = results.drive.known
    return f"{low:g} to {high:g} Hz"


def coverage_note(results: Results) -> str:
    """A note of what a load's table, or ISO 8608, does not say of the band; nothing if it says all."""
    load, speed = results.drive.load, results.conditions.speed
    if isinstance(load, Road) and load.roughness:
        return _iso_note(load, results.drive.known, speed)
    if not results.drive.is_partial:
        return ""
    at_speed = f" at {speed / factor('km/h', 'speed'):g} km/h" if isinstance(load, Road) else ""
    low, high = results.drive.known
    whole = results.prepared.frequency_hz
    return (
        f"{load.name} is known from {low:g} to {high:g} Hz{at_speed}: the answer is for this part, and "
        f"what the rest of {whole[0]:g} to {whole[-1]:g} Hz would add is unknown"
    )


def _iso_note(road: Road, band: tuple[float, float], speed: float) -> str:
    """A note of the frequencies at which a road of ISO 8608 is what the standard describes."""
    low, high = (n * speed for n in DESCRIBED)
    if low <= band[0] and band[1] <= high:
        return ""
    return (
        f"{road.name} is described by ISO 8608 from {low:.2g} to {high:.3g} Hz at "
        f"{speed / factor('km/h', 'speed'):g} km/h; outside, its line is carried on, flat below "
        f"{FLAT_BELOW * speed:.2g} Hz"
    )

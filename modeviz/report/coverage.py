"""Words for the part of a vehicle's band that an answer is of."""

from modeviz.analysis.results import Results
from modeviz.units import factor
from modeviz.vehicle.loads import Road


def band_text(results: Results) -> str:
    """Over what RMS values are taken, from the first line on: "0.1 to 40 Hz"."""
    low, high = results.drive.known
    return f"{low:g} to {high:g} Hz"


def coverage_note(results: Results) -> str:
    """A note of what a load's table does not hold, and so is not known; nothing if it holds all."""
    if not results.drive.is_partial:
        return ""
    name, speed = results.conditions.road, results.conditions.speed / factor("km/h", "speed")
    at_speed = f" at {speed:g} km/h" if isinstance(results.drive.load, Road) else ""
    low, high = results.drive.known
    whole = results.prepared.frequency_hz
    return (
        f"{name} is known from {low:g} to {high:g} Hz{at_speed}: the answer is for this part, and what "
        f"the rest of {whole[0]:g} to {whole[-1]:g} Hz would add is unknown"
    )

"""What the colours of bodies mean, as page text."""

from modeviz.export.wording import sentence_case
from modeviz.shapes.colors import COLOR_STOPS
from modeviz.viewer.answers import Solved
from modeviz.viewer.coloring import energy_shares, largest_share


def color_scale(solved: Solved) -> str:
    """The scale of the colours on one line; nothing if bodies have their own."""
    coloring = solved.state.coloring
    if coloring == "bodies":
        return ""
    if coloring == "displacement":
        last, about = 1.0, "Relative to the largest on the bodies"
    else:
        last, about = largest_share(energy_shares(solved)), "Share of each body in the whole vehicle's"
    return (
        f'<div class="scale" title="{about}"><span>{sentence_case(coloring)}</span><span>0</span>'
        f'<i style="background:linear-gradient(90deg,{",".join(COLOR_STOPS)})"></i>'
        f"<span>{100 * last:.0f} %</span></div>"
    )

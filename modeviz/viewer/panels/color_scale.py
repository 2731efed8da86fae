"""What the colours of bodies mean, as page text."""

from modeviz.shapes.colors import COLOR_STOPS
from modeviz.viewer.session.coloring import ColorScale


def color_scale_text(scale: ColorScale | None) -> str:
    """The scale of the colours on one line; nothing if bodies have their own."""
    if scale is None:
        return ""
    return (
        f'<div class="scale" title="{scale.about}"><span>{scale.quantity}</span><span>0</span>'
        f'<i style="background:linear-gradient(90deg,{",".join(COLOR_STOPS)})"></i>'
        f"<span>{scale.last}</span></div>"
    )

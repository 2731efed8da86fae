"""Numbers and names as people write them."""

MINUS = "\N{MINUS SIGN}"


def number(value: float, decimals: int) -> str:
    """A number with a true minus."""
    text = f"{abs(value):.{decimals}f}"
    return MINUS + text if value < 0 and float(text) else text


def signed(value: float, decimals: int, unit: str = "") -> str:
    """A change with its sign and a true minus; nothing but the number where it rounds to zero."""
    text = f"{abs(value):.{decimals}f}"
    sign = "" if float(text) == 0 else "+" if value > 0 else MINUS
    return f"{sign}{text}{unit}"


def sentence_case(name: str) -> str:
    """A name with a capital, for a widget, which shows it as it is; "~cab yaw" is "~Cab yaw"."""
    mark, rest = ("~", name[1:]) if name.startswith("~") else ("", name)
    return mark + rest[:1].upper() + rest[1:]

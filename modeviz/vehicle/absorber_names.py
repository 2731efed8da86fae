"""What the parts of an absorber are called."""


def mass_name(absorber: str) -> str:
    """Return what its mass is called among the bodies."""
    return f"{absorber} mass"


def guide_name(absorber: str) -> str:
    """Return what the joint that guides it is called among the connections."""
    return f"{absorber} guide"

"""The colours of a COLLADA file: those of its effects; textures are in other files."""

from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np

from modeviz.files.mesh_formats.dae_document import Dae, values
from modeviz.vehicle.bodies import Material

SHADERS = ("phong", "blinn", "lambert", "constant")


def material_of(dae: Dae, material: Element | None, plain: Material) -> Material:
    """The look that a material has, or `plain` if that is a texture or nothing.

    Raises:
        VehicleError: it names an effect that is not there.
    """
    instance = None if material is None else material.find("instance_effect")
    if instance is None:
        return plain
    technique = dae.named(instance, "url").find("profile_COMMON/technique")
    shader = next((e for e in technique or () if e.tag in SHADERS), None)
    if shader is None:
        return plain
    color = shader.find("diffuse/color")
    if color is None:
        color = shader.find("emission/color") if shader.tag == "constant" else None
    if color is None:
        return plain
    red, green, blue, *_ = np.rint(255 * values(color, 4).clip(0, 1)).astype(int).tolist()
    return replace(plain, color=(red, green, blue), opacity=_opacity(shader))


def _opacity(shader: Element) -> float:
    """What is seen of a surface; one where an exporter writes that nothing is, as some do.

    COLLADA 1.4.1, "Determining transparency": A_ONE, and RGB_ZERO, in which colour and transparency are
    the other way round.
    """
    transparent, share = shader.find("transparent"), shader.find("transparency/float")
    amount = 1.0 if share is None else float(values(share, 1).clip(0, 1)[0])
    color = None if transparent is None else transparent.find("color")
    if transparent is None or color is None:
        return amount or 1.0
    rgba = values(color, 4).clip(0, 1)
    if transparent.get("opaque", "A_ONE") == "RGB_ZERO":
        return float(1 - amount * rgba[:3].mean()) or 1.0
    return float(amount * rgba[3]) or 1.0

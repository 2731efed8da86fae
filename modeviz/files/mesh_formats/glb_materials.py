"""The materials of a binary glTF file: one colour each, whatever textures and vertices say."""

import warnings
from io import BytesIO

import numpy as np
from PIL import Image, UnidentifiedImageError

from modeviz.errors import VehicleError, reason
from modeviz.files.mesh_formats.glb_arrays import scaled, values
from modeviz.files.mesh_formats.glb_document import Glb, embedded, item
from modeviz.files.mesh_formats.glb_records import MaterialRecord, Primitive
from modeviz.files.mesh_formats.limits import MOST_PIXELS, check_size
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Material
from modeviz.vehicle.srgb import linear_to_srgb, srgb_to_linear

IMAGE_FORMATS = ("PNG", "JPEG")

LINEAR = srgb_to_linear(np.arange(256) / 255)
"""Linear light of the 256 levels of a pixel."""


class Materials:
    """The materials of a file, textures read once."""

    def __init__(self, glb: Glb, plain: Material) -> None:
        """Reads nothing yet; primitives without material and colours are `plain`."""
        self._glb, self._plain = glb, plain
        self._means: dict[int, Floats] = {}
        self._n_pixels = 0

    def of(self, primitive: Primitive, vertices: Array) -> Material:
        """The look of a primitive as a whole.

        Args:
            primitive: of the file.
            vertices: numbers of those that it draws, whose colours are averaged.

        Raises:
            VehicleError: what it names is not there, or its image is damaged.
        """
        color = self._vertex_color(primitive, vertices)
        if primitive.material is None:
            return self._plain if color is None else _material(MaterialRecord(), color, self._plain)
        record = item(self._glb.document.materials, primitive.material, "materials")
        surface = record.pbr_metallic_roughness
        factor = np.clip(surface.base_color_factor, 0, 1)
        if surface.base_color_texture is not None:
            factor = factor * self._mean(surface.base_color_texture.index)
        shine = np.clip([surface.roughness_factor, surface.metallic_factor], 0, 1).tolist()
        looks = Material((0, 0, 0), 1.0, *shine)
        return _material(record, factor if color is None else factor * color, looks)

    def _vertex_color(self, primitive: Primitive, vertices: Array) -> Floats | None:
        """The mean colour of a primitive's vertices, linear RGBA."""
        index = primitive.attributes.get("COLOR_0")
        if index is None:
            return None
        stored = values(self._glb, index, "VEC3", "VEC4")
        if vertices.max() >= len(stored):
            raise VehicleError(f"accessors[{index}]: has no colour for vertex {vertices.max()}")
        colors = scaled(stored[vertices], self._glb.document.accessors[index])
        mean = np.nan_to_num(colors).clip(0, 1).mean(axis=0)
        return np.append(mean, 1.0)[:4]

    def _mean(self, texture: int) -> Floats:
        """The mean colour of a texture, linear RGBA; white if it has no image that is read."""
        source = item(self._glb.document.textures, texture, "textures").source
        if source is None:
            return np.ones(4)
        if source not in self._means:
            image = _opened(self._image(source), f"images[{source}]")
            self._n_pixels += image.width * image.height
            check_size("pixels of textures", self._n_pixels, MOST_PIXELS)
            self._means[source] = _mean_color(image, f"images[{source}]")
        return self._means[source]

    def _image(self, index: int) -> bytes:
        record = item(self._glb.document.images, index, "images")
        if record.buffer_view is not None:
            return bytes(self._glb.view(record.buffer_view))
        return embedded(record.uri or "", f"images[{index}]")


def _material(record: MaterialRecord, linear: Floats, looks: Material) -> Material:
    """A material of a linear RGBA colour, whose alpha counts as the record says."""
    red, green, blue = np.rint(255 * linear_to_srgb(linear[:3])).astype(int).tolist()
    match record.alpha_mode:
        case "BLEND":
            opacity = float(linear[3])
        case "MASK":  # a texture cuts holes, which a mean does not have
            factor = record.pbr_metallic_roughness.base_color_factor
            opacity = 1.0 if factor[3] >= record.alpha_cutoff else 0.0
        case "OPAQUE":
            opacity = 1.0
    return Material((red, green, blue), opacity, looks.roughness, looks.metallic)


def _opened(content: bytes, key: str) -> Image.Image:
    """An image, of which nothing is decoded yet; a JPEG will be decoded small."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of sizes, which are checked here
            image = Image.open(BytesIO(content), formats=IMAGE_FORMATS)
            image.draft("RGB", (image.width // 8, image.height // 8))
            return image
    except UnidentifiedImageError:
        raise VehicleError(f"{key}: found no PNG or JPEG") from None
    except Image.DecompressionBombError as error:
        raise VehicleError(f"{key}: is far too large ({reason(error)})") from None
    except (OSError, SyntaxError, ValueError) as error:
        raise VehicleError(f"{key}: is not a whole image ({reason(error)})") from None


def _mean_color(image: Image.Image, key: str) -> Floats:
    """The mean colour of an image, linear RGBA; of what is clear only the alpha counts."""
    try:
        pixels = image.convert("RGBA")
    except (OSError, SyntaxError, ValueError) as error:
        raise VehicleError(f"{key}: is not a whole image ({reason(error)})") from None
    channel = pixels.getchannel("A")
    alpha = np.array(channel.histogram())
    seen = channel.point(lambda level: 255 if level else 0)
    counts = np.array(pixels.histogram(seen)).reshape(4, 256)[:3]
    color = counts @ LINEAR / max(int(alpha[1:].sum()), 1)
    return np.append(color, alpha @ np.arange(256) / 255 / alpha.sum())

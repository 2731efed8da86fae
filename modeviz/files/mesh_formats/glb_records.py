"""The JSON of a glTF 2.0 file, as far as it is read.

glTF 2.0 specification, section 5 (Khronos Group, ISO/IEC 12113).
"""

from typing import Annotated, Literal

from msgspec import Meta, Struct, field

Natural = Annotated[int, Meta(ge=0)]
ComponentType = Literal[5120, 5121, 5122, 5123, 5125, 5126]
Width = Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]
Three = tuple[float, float, float]
Four = tuple[float, float, float, float]


class Part(Struct, rename="camel"):
    """An object of the JSON; keys that are not listed are left alone."""


class Buffer(Part):
    """buffers[]."""

    byte_length: Annotated[int, Meta(ge=1)]
    uri: str | None = None


class BufferView(Part):
    """bufferViews[]: a stretch of a buffer."""

    buffer: Natural
    byte_length: Annotated[int, Meta(ge=1)]
    byte_offset: Natural = 0
    byte_stride: Annotated[int, Meta(ge=4, le=252)] | None = None


class SparseIndices(Part):
    """The rows of an accessor that are replaced."""

    buffer_view: Natural
    component_type: Literal[5121, 5123, 5125]
    byte_offset: Natural = 0


class SparseValues(Part):
    """The values that replace rows of an accessor."""

    buffer_view: Natural
    byte_offset: Natural = 0


class Sparse(Part):
    """Rows of an accessor that are given one by one."""

    count: Annotated[int, Meta(ge=1)]
    indices: SparseIndices
    values: SparseValues


class Accessor(Part):
    """accessors[]: rows of numbers."""

    component_type: ComponentType
    count: Annotated[int, Meta(ge=1)]
    type: Width
    buffer_view: Natural | None = None
    byte_offset: Natural = 0
    normalized: bool = False
    sparse: Sparse | None = None


class Primitive(Part):
    """meshes[].primitives[]: faces of one material."""

    attributes: dict[str, Natural]
    indices: Natural | None = None
    material: Natural | None = None
    mode: Annotated[int, Meta(ge=0, le=6)] = 4


class SurfaceRecord(Part):
    """meshes[]."""

    primitives: list[Primitive]
    name: str = ""


class NodeRecord(Part):
    """nodes[]: places a mesh, and other nodes."""

    name: str = ""
    mesh: Natural | None = None
    children: list[Natural] = []
    matrix: Annotated[list[float], Meta(min_length=16, max_length=16)] | None = None
    translation: Three = (0.0, 0.0, 0.0)
    rotation: Four = (0.0, 0.0, 0.0, 1.0)
    scale: Three = (1.0, 1.0, 1.0)


class SceneRecord(Part):
    """scenes[]."""

    nodes: list[Natural] = []


class TextureReference(Part):
    """The texture of a material."""

    index: Natural


class Roughness(Part):
    """materials[].pbrMetallicRoughness."""

    base_color_factor: Four = (1.0, 1.0, 1.0, 1.0)
    base_color_texture: TextureReference | None = None
    metallic_factor: float = 1.0
    roughness_factor: float = 1.0


class MaterialRecord(Part):
    """materials[]."""

    pbr_metallic_roughness: Roughness = field(default_factory=Roughness)
    alpha_mode: Literal["OPAQUE", "MASK", "BLEND"] = "OPAQUE"
    alpha_cutoff: float = 0.5


class TextureRecord(Part):
    """textures[]."""

    source: Natural | None = None


class ImageRecord(Part):
    """images[]."""

    uri: str | None = None
    buffer_view: Natural | None = None


class Document(Part):
    """The JSON of a file, as far as it is read."""

    accessors: list[Accessor] = []
    buffers: list[Buffer] = []
    buffer_views: list[BufferView] = []
    extensions_required: list[str] = []
    images: list[ImageRecord] = []
    materials: list[MaterialRecord] = []
    meshes: list[SurfaceRecord] = []
    nodes: list[NodeRecord] = []
    scene: Natural | None = None
    scenes: list[SceneRecord] = []
    textures: list[TextureRecord] = []

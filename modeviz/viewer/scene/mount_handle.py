"""The handle in the scene by which the mounts of a group are moved and turned."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import copy_context
from dataclasses import dataclass

import numpy as np
import viser
from viser.transforms import SO3

from modeviz.vehicle.local_axes import TurnOrder, angles_of_axes, axes_of_angles
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.placement import Placement, mirrored_mounts
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.session.worker import Worker

SIZE_PX = 90.0
"""Length of its arrows on the page, wherever the camera is: a hand is as large for every vehicle."""

LINE_PX = 4.0
"""Width of its lines; a pointer takes hold of some 9 pixels to either side of an arrow."""

OFFSET_DECIMALS, ANGLE_DECIMALS = 5, 2
"""Of m and of degrees: no hand is as steady."""


@dataclass(frozen=True)
class Dragged:
    """Where somebody has dragged a handle to."""

    group: str
    placement: Placement
    """Of the group's first mount."""
    drag: int
    """The number of the drag."""
    is_over: bool
    """Whether it was let go."""
    client: viser.ClientHandle | None


class MountHandle:
    """Arrows and arcs at one mount of a group; whoever drags it is told on."""

    def __init__(
        self,
        scene: viser.SceneApi,
        on_drag: Callable[[Dragged], None],
        mistake: Callable[[Exception], object],
        has_control: Callable[[int], bool],
    ) -> None:
        """Makes it, and leaves it out.

        Args:
            scene: of the page.
            on_drag: told where it was dragged to, in a thread; places that were overtaken are not.
            mistake: told what that raises.
            has_control: whether a page may drag it on, and is there at all.
        """
        self._on_drag, self._has_control = on_drag, has_control
        self._teller: Worker[Callable[[], None]] = Worker(lambda tell: tell(), mistake)
        self._held: tuple[MountGroup, int] | None = None
        self._n_drags = 0
        self._dragged_by: int | None = None
        """The page."""
        self._handle = scene.add_transform_controls(
            "/mount handle", SIZE_PX, line_width=LINE_PX, fixed=True, depth_test=False, visible=False
        )
        self._handle.on_update(self._moved)

    def show(self, group: MountGroup, mount: int, placement: Placement) -> None:
        """Shows it at a mount.

        Args:
            group: with its mounts where they were given.
            mount: which of them.
            placement: of the group, as it is now.
        """
        if self._is_in_hand and self._held and self._held[0].name == group.name:
            return  # it is where the hand has it
        self._held, self._dragged_by = (group, mount), None
        own = placement.mirrored if mirrored_mounts(group)[mount] else placement
        axes = axes_of_angles(np.array(own.angles), TurnOrder())
        self._handle.position = group.mounts[mount].center + own.offset
        self._handle.wxyz = SO3.from_matrix(axes.T).wxyz
        assign(self._handle, visible=True)

    def hide(self) -> None:
        """Leaves it out."""
        self._dragged_by = None
        assign(self._handle, visible=False)

    @contextmanager
    def away(self) -> Iterator[None]:
        """Leaves it out inside the block, whatever is seen of the scene there."""
        was = self._handle.visible
        assign(self._handle, visible=False)
        try:
            yield
        finally:
            assign(self._handle, visible=was)

    def close(self) -> None:
        """Tells nobody any more."""
        self._teller.close()

    @property
    def _is_in_hand(self) -> bool:
        return self._dragged_by is not None and self._has_control(self._dragged_by)

    async def _moved(self, event: viser.TransformControlsEvent) -> None:
        """Has it told where it is, in the order in which pages say so."""
        if self._held is None or not self._handle.visible:
            return
        group, mount = self._held
        is_over = event.phase == "end"
        placement = _placement(self._handle, group, mount)
        self._dragged_by = None if is_over else event.client_id
        dragged = Dragged(group.name, placement, self._n_drags, is_over, event.client)
        heard = copy_context()  # its author is whose page is heard now
        self._teller.submit(lambda: heard.run(self._on_drag, dragged))
        self._n_drags += is_over


def _placement(handle: viser.TransformControlsHandle, group: MountGroup, mount: int) -> Placement:
    """The placement of a group one of whose mounts is at a handle."""
    offset = np.round(handle.position - group.mounts[mount].center, OFFSET_DECIMALS)
    degrees = np.degrees(angles_of_axes(SO3(handle.wxyz).as_matrix().T.astype(np.float64)))
    angles = np.radians(np.round(degrees, ANGLE_DECIMALS))
    own = Placement(tuple(offset), tuple(angles))
    return own.mirrored if mirrored_mounts(group)[mount] else own

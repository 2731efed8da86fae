"""Where the study of a vehicle lies."""

import hashlib
import os
from pathlib import Path

from modeviz.files.state_folder import state_folder
from modeviz.text.wording import file_name

ENDING = "modeviz"


def study_path(folder: Path, is_ours: bool = False) -> Path:
    """Return the file of the study of a vehicle folder: beside it, "truck.modeviz" of "truck".

    It is not in the folder, which is written anew as a whole. Where nothing can be written beside the
    folder, and of a vehicle that comes with modeviz, the file is in `own_folder`.

    Args:
        folder: of the vehicle.
        is_ours: whether it comes with modeviz.
    """
    whole = folder.resolve()
    beside = whole.with_name(f"{whole.name}.{ENDING}")
    if not is_ours and (beside.exists() or _takes_files(whole.parent)):
        return beside
    return own_folder() / (file_name(whole.name, ENDING) if is_ours else _elsewhere(whole))


def own_folder() -> Path:
    """Return the folder of a user in which studies lie that have no other place; it may be missing."""
    return state_folder() / "studies"


def _takes_files(folder: Path) -> bool:
    return os.access(folder, os.W_OK | os.X_OK)


def _elsewhere(folder: Path) -> str:
    """A name that tells folders of the same name apart."""
    told = hashlib.sha256(str(folder).encode(errors="surrogateescape")).hexdigest()[:8]
    return file_name(f"{folder.name}-{told}", ENDING)

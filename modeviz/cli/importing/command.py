"""The command that puts what other programs wrote into a vehicle folder."""

from modeviz.cli.command import Command
from modeviz.cli.importing.body import import_component
from modeviz.cli.importing.mounts import import_mounts
from modeviz.cli.importing.options import ImportOptions, add_options
from modeviz.cli.importing.roads import import_road_file
from modeviz.cli.results import check_printable
from modeviz.formats.endings import check_taken
from modeviz.formats.mounts.imported import holds_mounts
from modeviz.formats.roads.imported import holds_road


def import_files(options: ImportOptions) -> None:
    """Lists what files have, or puts it into a vehicle folder."""
    check_printable()
    check_taken(options.files)
    if holds_road(options.files):
        import_road_file(options.files, options.output, options.road)
    elif holds_mounts(options.files, is_put=options.output is not None):
        import_mounts(options.files, options.output, options.mounts)
    else:
        import_component(options)


IMPORT = Command(
    "import",
    "bodies, mounts and roads of other programs into a vehicle folder",
    ImportOptions,
    add_options,
    import_files,
)

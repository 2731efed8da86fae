"""A body out of files of other programs, listed or put into a vehicle folder."""

from pathlib import Path

from modeviz.cli.importing.listing import listing
from modeviz.cli.importing.mounts import list_springs_beside
from modeviz.cli.importing.options import ImportOptions
from modeviz.cli.importing.summary import summary
from modeviz.cli.news import News
from modeviz.cli.results import print_result
from modeviz.cli.terminal import remark
from modeviz.formats.component import Component
from modeviz.formats.imported import ImportSettings, import_body
from modeviz.formats.reading import read_component
from modeviz.formats.solving import solved
from modeviz.report.truncation import import_notes


def import_component(options: ImportOptions) -> None:
    """Lists what files have of a component, and puts it into a vehicle folder if there is one.

    Raises:
        ModevizError: what is asked for has no effect, or the files cannot be read, or do not fit.
    """
    settings = options.body
    component = read_component(options.files)
    for note in component.notes:
        remark(f"{component.source}: {note}")
    if options.output is None:
        print_result(listing(solved(component, settings.wanted)))
        list_springs_beside(options.files)
    else:
        _put(component, options.name or options.files[0].stem, settings, options.output)


def _put(component: Component, name: str, settings: ImportSettings, folder: Path) -> None:
    news = News(folder)
    imported = import_body(component, name, settings, folder)
    assert imported.vehicle
    for note in (*imported.notes, *import_notes(imported.body)):
        remark(note)
    news.tell(imported.vehicle, imported.body.name)
    print_result(summary(imported.body, imported.attachments, folder))

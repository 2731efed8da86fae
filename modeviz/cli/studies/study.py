"""The commands on the file of a study, which stand behind `modeviz study`."""

from modeviz.cli.command import CommandGroup
from modeviz.cli.studies.backup import BACKUP
from modeviz.cli.studies.check import CHECK
from modeviz.cli.studies.diff import DIFF
from modeviz.cli.studies.export import EXPORT
from modeviz.cli.studies.log import LOG
from modeviz.cli.studies.note import NOTE

STUDY = CommandGroup(
    "study",
    "history, notes, export, comparison, backup and check of a study",
    (LOG, NOTE, EXPORT, DIFF, BACKUP, CHECK),
)

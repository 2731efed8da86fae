"""The report of a comparison: one HTML file that needs nothing else."""

from modeviz.export.report.page import Picture as Picture
from modeviz.export.report.page import report as report

"""The report of a comparison: one HTML file that needs nothing else."""

from modeviz.report.html.page import Picture as Picture
from modeviz.report.html.page import report as report

"""Files of other programs: each format a module that reads them as a `Component`."""

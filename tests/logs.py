"""Loggers whose words are kept."""

import logging


class _Kept(logging.Handler):
    def __init__(self, texts):
        super().__init__()
        self._texts = texts

    def emit(self, record):
        self._texts.append(record.getMessage())


def log_to(texts: list[str]) -> logging.Logger:
    """A logger that appends what it is told to a list."""
    log = logging.Logger("kept")
    log.addHandler(_Kept(texts))
    return log

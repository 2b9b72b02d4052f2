"""Errors that can happen while a report is drawn."""

from cases.shell.errors import InputError


class ReportError(InputError):
    """A comparison directory cannot be reported; the message names the file and what is wrong in it."""

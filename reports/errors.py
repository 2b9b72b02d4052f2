"""Errors that can happen while a report is drawn."""


class ReportError(Exception):
    """A comparison directory cannot be reported; the message names the file and what is wrong in it."""

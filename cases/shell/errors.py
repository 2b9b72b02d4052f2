"""The one error that every package's own errors are kinds of."""


class InputError(Exception):
    """What a user can mend: a command ends with its message, and with the status of a wrong input."""

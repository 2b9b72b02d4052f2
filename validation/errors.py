"""What can be wrong with a comparison's input."""

from cases.shell.errors import InputError


class ValidationError(InputError):
    """Base of everything this package raises on purpose."""


class UnusableReferenceError(ValidationError):
    """A 3D reference cannot be brought onto the cells of the reduced model."""

"""What can be wrong with a comparison's input."""


class ValidationError(Exception):
    """Base of everything this package raises on purpose."""


class UnusableReferenceError(ValidationError):
    """A 3D reference cannot be brought onto the cells of the reduced model."""

"""What checksums.json holds: what determines a result, and the files that it consists of."""

from cases.results.provenance import Checksum
from cases.results.record import Record


class Seal(Record):
    """A finished result, as it was written.

    Attributes
    ----------
    determined_by : str
        Digest of the case, of the files that it reads, of the code and of the libraries' versions.
    created : str
        When, ISO 8601.
    warnings : tuple of str
        What the comparison warned of.
    files : dict of str to str
        SHA-256 of every other file of the result, by name.
    """

    determined_by: Checksum
    created: str
    warnings: tuple[str, ...]
    files: dict[str, Checksum]

"""Whether the three files of a comparison directory are about one comparison."""

import codecs
import hashlib
from collections.abc import Iterable, Sequence
from pathlib import Path

from cases.results.provenance import Provenance
from reports.errors import ReportError
from reports.result.dataset import Attributes
from reports.result.metrics import Metrics


def check_consistency(
    directory: Path,
    variants: Sequence[str],
    attributes: Attributes,
    metrics: Metrics,
    provenance: Provenance,
) -> None:
    """Compare what comparison.nc, metrics.json and provenance.json of `directory` each say.

    Raises
    ------
    ReportError
        If the case's name, the variants' names or the case file's text differ; the message names the place.
    """
    _check_rows(directory / "metrics.json", variants, attributes.case, metrics)
    path = directory / "provenance.json"
    if set(provenance.variants) != set(variants):
        raise ReportError(
            f"{path}: variants are {_names(provenance.variants)}; comparison.nc has {_names(variants)}"
        )
    for number, band in enumerate(provenance.bands, start=1):
        unknown = [name for name in band.variants or () if name not in variants]
        if unknown:
            raise ReportError(
                f"{path}: bands, row {number}: variant {unknown[0]!r} is none of {_names(variants)}"
            )
    if provenance.case.sha256 not in _checksums(attributes.case_yaml):
        raise ReportError(
            f"{path}: case, sha256 is {provenance.case.sha256}, which is not that of the case file's text "
            "in comparison.nc (case_yaml)"
        )


def _check_rows(path: Path, variants: Sequence[str], case: str, metrics: Metrics) -> None:
    for number, row in enumerate(metrics.rows, start=1):
        if row.case != case:
            raise ReportError(f"{path}: row {number}: case is {row.case!r}; comparison.nc is of {case!r}")
        if row.variant not in variants:
            raise ReportError(f"{path}: row {number}: variant {row.variant!r} is none of {_names(variants)}")


def _names(names: Iterable[str]) -> str:
    return ", ".join(names) or "none"


def _checksums(text: str) -> set[str]:
    """Checksums of the files that are read as `text`: with either line ending, with or without a mark."""
    unix = text.replace("\r\n", "\n")
    contents = [t.encode() for t in (text, unix, unix.replace("\n", "\r\n"))]
    return {
        hashlib.sha256(mark + content).hexdigest() for mark in (b"", codecs.BOM_UTF8) for content in contents
    }

"""A sweep's folder, read and checked before anything is drawn."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
from pydantic import TypeAdapter

from cases.arrays import Floats
from cases.results.sweep import FAILED, OK, KeptOutput, OutputBand, SweepAccount, VariedParameter
from reports.errors import ReportError
from reports.result.strict_json import read_json

STUDY, SAMPLES = "study.json", "samples"
_UNREADABLE = (OSError, ValueError)  # pyarrow's own errors are ValueErrors


@dataclass(frozen=True)
class Sweep:
    """A sweep.

    Attributes
    ----------
    study : SweepAccount
        What study.json holds.
    text : str
        The study as it was read (study.yaml); "" without one.
    samples : pandas.DataFrame
        A row a sample, by its number: variant, status, error, and a column (SI) for each parameter and
        output.
    """

    study: SweepAccount
    text: str
    samples: pd.DataFrame

    @property
    def variants(self) -> tuple[str, ...]:
        """Variants of the base case that were run."""
        return tuple(self.study.variants)

    def done(self, variant: str) -> pd.DataFrame:
        """Return the samples of a variant that have values."""
        return self.samples[(self.samples["variant"] == variant) & (self.samples["status"] == OK)]

    def band(self, variant: str, output: KeptOutput) -> OutputBand | None:
        """Return the band that judges an output of a variant."""
        band = output.band
        if band is None or (band.variants is not None and variant not in band.variants):
            return None
        return band

    def judged(self, variant: str) -> tuple[tuple[KeptOutput, OutputBand], ...]:
        """Return the outputs of a variant that a band judges, with it."""
        found = ((output, self.band(variant, output)) for output in self.study.outputs)
        return tuple((output, band) for output, band in found if band)


def load_sweep(directory: Path) -> Sweep:
    """Read study.json and the samples recorded so far.

    Raises
    ------
    ReportError
        If a file is absent or damaged, no sample is recorded, or both do not belong together.
    """
    study = read_json(directory / STUDY, TypeAdapter(SweepAccount))
    path = directory / SAMPLES
    parts = sorted(path.glob("[!.]*.parquet"))
    if not parts:
        raise ReportError(f"{path}: no sample is recorded yet")
    samples = pd.concat([_read(part) for part in parts], ignore_index=True)
    _check(path, study, samples)
    text = directory / "study.yaml"
    try:
        words = text.read_text(encoding="utf-8") if text.is_file() else ""
    except (OSError, UnicodeDecodeError) as error:
        raise ReportError(f"{text}: cannot be read: {error}") from error
    return Sweep(study, words, samples.sort_values("sample").reset_index(drop=True))


def _read(part: Path) -> pd.DataFrame:
    """Read a part; one whose pages are not as they were written is refused."""
    try:
        return pd.read_parquet(part, engine="pyarrow", page_checksum_verification=True)
    except _UNREADABLE as error:
        reason = str(error).partition("\n")[0]
        raise ReportError(
            f"{part}: cannot be read as Parquet: {reason}; the sweep's own command computes it again"
        ) from error


def _check(path: Path, study: SweepAccount, samples: pd.DataFrame) -> None:
    numbers = [parameter.name for parameter in study.parameters]
    numbers += [output.name for output in study.outputs]
    missing = [name for name in ("sample", "variant", "status", "error", *numbers) if name not in samples]
    if missing:
        raise ReportError(f"{path}: without column {', '.join(missing)}, which {STUDY} or a sweep has")
    texts = [name for name in numbers if samples[name].dtype.kind not in "fiu"]
    if texts:
        raise ReportError(f"{path}: {texts[0]} is of type {samples[texts[0]].dtype}; numbers are expected")
    for column, allowed in (("variant", list(study.variants)), ("status", [OK, FAILED])):
        found = [value for value in samples[column].unique() if value not in allowed]
        if found:
            raise ReportError(f"{path}: {column} {found[0]!r}; {', '.join(allowed)} are allowed")
    doubled = samples["sample"][samples["sample"].duplicated()]
    if len(doubled):
        raise ReportError(f"{path}: sample {doubled.iloc[0]} is recorded twice")


def shown(item: VariedParameter | KeptOutput, samples: pd.DataFrame) -> Floats:
    """Values of a parameter or output in the unit that people read."""
    return np.asarray(samples[item.name].to_numpy(dtype=float) * item.display_factor)

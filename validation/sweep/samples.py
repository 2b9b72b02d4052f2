"""Samples of a study: the points of its design, each checked as a case of its own."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from cases.arrays import Floats
from cases.errors import CaseFileError
from cases.reading.numeric_keys import NumericKey
from cases.reading.template import case_with
from cases.reading.yaml_nodes import Scalar
from cases.sections.case import Case
from validation.sweep.design import points
from validation.sweep.spans import CENTRE, EXTENT, ends_of
from validation.sweep.study import Study

Keys = tuple[str | int, ...]
FIRST_CHECKED = 64


@dataclass(frozen=True)
class Sample:
    """One point of a design, of one variant.

    Attributes
    ----------
    number : int
        Counted from 0 through all variants.
    variant : str
        The variant.
    values : tuple of float
        Of the parameters, SI.
    case : Case or None
        The case to run; None where the values are not allowed.
    error : str
        What is not allowed; empty where there is a case.
    """

    number: int
    variant: str
    values: tuple[float, ...]
    case: Case | None
    error: str = ""


@dataclass(frozen=True)
class Samples:
    """All samples of a study, made as they are asked for.

    Attributes
    ----------
    study : Study
    points : ndarray (n, n_parameters)
        Values of the design, SI; each variant takes all of them.
    """

    study: Study
    points: Floats

    def __len__(self) -> int:
        """Count the samples."""
        return len(self.points) * len(self.study.templates)

    def __getitem__(self, number: int) -> Sample:
        """Make one sample."""
        variant = list(self.study.templates)[number // len(self.points)]
        values = tuple(self.points[number % len(self.points)].tolist())
        keys = [parameter.key for parameter in self.study.parameters]
        try:
            own = self.study.cases[variant]
            case = case_with(self.study.templates[variant], _stated(own, keys, values), own)
        except CaseFileError as error:
            return Sample(number, variant, values, None, str(error).replace("\n", "; "))
        return Sample(number, variant, values, case)

    def block(self, numbers: Sequence[int]) -> list[Sample]:
        """Make some samples."""
        return [self[number] for number in numbers]


def samples_of_study(study: Study) -> Samples:
    """Return the samples of a study.

    Raises
    ------
    CaseFileError
        None of the first samples is a case that may be run: the study cannot be meant so.
    """
    samples = Samples(study, points(study.design, study.parameters))
    first = ""
    for sample in _spread(samples):
        if sample.case is not None:
            return samples
        first = first or sample.error
    message = f"{study.path}: parameters: no sample is a case that may be run; the first one: {first}"
    raise CaseFileError(study.path, message)


def _spread(samples: Samples) -> Iterator[Sample]:
    """Make some samples from all over the design."""
    for number in np.unique(np.linspace(0, len(samples) - 1, FIRST_CHECKED).astype(int)):
        yield samples[int(number)]


def _stated(case: Case, keys: Sequence[NumericKey], values: Sequence[float]) -> dict[Keys, Scalar]:
    """Return values as the case file would state them, by the keys that lead there."""
    pairs = list(zip(keys, values, strict=True))
    spans = {key.path: value for key, value in pairs if key.path[-1] in (CENTRE, EXTENT)}
    return {key.path: key.stated(value) for key, value in pairs if key.path not in spans} | ends_of(
        case, spans
    )

"""Content of study.json of a sweep."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, JsonValue, TypeAdapter

from reports.result.strict_json import read_json

Count = Annotated[int, Field(ge=0)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class _Record(BaseModel):
    model_config = ConfigDict(strict=True, frozen=True, allow_inf_nan=False, extra="ignore")


class Parameter(_Record):
    """A number of the case that the sweep varies.

    Attributes
    ----------
    name, label : str
        Its key in the case, which is its column in the samples; words for people.
    unit : str
        What people read it in.
    display_factor : float
        Value in `unit` = stored SI value × display_factor.
    kind : str
        ``list``, ``range`` or the distribution's name.
    low, high : float or None
        Ends of what may be drawn, SI; None where a distribution has none.
    values : tuple of float or None
        The values of a list or range, SI.
    base : float or None
        The base case's own value, SI.
    """

    name: str
    label: str
    unit: str
    display_factor: Positive
    kind: str
    low: float | None = None
    high: float | None = None
    values: tuple[float, ...] | None = None
    base: float | None = None


class Band(_Record):
    """A limit on an output's size, SI, and the variants it is for; None for all."""

    limit: Annotated[float, Field(ge=0)]
    reason: str
    variants: tuple[str, ...] | None = None


class Output(_Record):
    """A number kept of each sample; `unit` and `display_factor` as of a parameter."""

    name: str
    label: str
    unit: str
    display_factor: Positive
    band: Band | None = None


class Index(_Record):
    """Sobol indices of one output with respect to one parameter, and half widths of their intervals."""

    variant: str
    output: str
    parameter: str
    S1: float | None
    S1_conf: float | None
    ST: float | None
    ST_conf: float | None


class Design(_Record):
    """How samples were chosen."""

    kind: str
    samples: Count
    seed: int | None = None


class Counts(_Record):
    """How many samples are recorded, and how many of these failed."""

    done: Count
    failed: Count
    total: Count


class Study(_Record):
    """All that is not of one sample."""

    name: str
    title: str
    base_case: str
    variants: dict[str, str]
    created: str
    git_commit: str | None = None
    versions: dict[str, JsonValue]
    design: Design
    against: str | None = None
    parameters: Annotated[tuple[Parameter, ...], Field(min_length=1)]
    outputs: Annotated[tuple[Output, ...], Field(min_length=1)]
    state: Literal["finished", "interrupted", "running"]
    counts: Counts
    sensitivity: tuple[Index, ...] | None = None


_SCHEMA = TypeAdapter(Study)


def read_study(path: Path) -> Study:
    """Read study.json.

    Raises
    ------
    ReportError
        If a key is absent or its value is of another type than declared above.
    """
    return read_json(path, _SCHEMA)

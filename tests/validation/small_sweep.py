"""Studies of the ready case on a coarse grid, in a folder of their own, for tests to edit."""

from pathlib import Path
from typing import Any

import pandas as pd
from ruamel.yaml import YAML
from small_case import small_case, written

from validation.sweep.run import Where, run_sweep
from validation.sweep.study import Study, load_study

GRID = {
    "calcification.youngs_modulus": ["1 MPa", "10 MPa"],
    "calcification.x.extent": ["2 mm", "5 mm", "20 mm"],  # the last one leaves the artery
}


def study_file(folder: Path, *variants: str, case: dict[str, Any] | None = None, **keys: Any) -> Path:
    """Write a study, and the case that it names; ``keys`` replace or, if None, remove those of the study."""
    written(case or small_case(*(variants or ("local",))), folder)
    stated: dict[str, Any] = {"name": "trial", "base": "small.yaml", "parameters": GRID, "chunk": 2}
    stated |= {"error_tolerance": "none"}  # steps as of the runs that samples are held against
    stated = {key: value for key, value in (stated | keys).items() if value is not None}
    path = folder / "study.yaml"
    with path.open("w", encoding="utf-8") as stream:
        YAML().dump(stated, stream)
    return path


def small_study(folder: Path, *variants: str, **keys: Any) -> Study:
    return load_study(study_file(folder, *variants, **keys))


def swept(study: Study, folder: Path, fresh: bool = False) -> pd.DataFrame:
    """Run a study with two threads; its records by number."""
    run_sweep(study, Where(folder, "threads", 2, fresh), print)
    return records(folder)


def records(folder: Path) -> pd.DataFrame:
    """All records of a sweep but the times that they took, which no two runs share."""
    return (
        pd.read_parquet(folder / "samples").sort_values("sample", ignore_index=True).drop(columns="seconds")
    )

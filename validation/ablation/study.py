"""Each model between the thesis's and the coupled one against the same 3D run: runs, rows and their table."""

import time
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pandas as pd
from rich.table import Table

from cases.arrays import Floats
from cases.reading.case_file import CaseFile
from cases.results.ablation import MEASURES, AblationRow
from cases.sections.calcification import LocalCalcification
from cases.sections.case import Case
from cases.shell.whole import write_text, writing
from reports.build import write_reports
from solver.case.model import grid_of
from solver.errors import SolverError
from validation.ablation.ladder import models_between
from validation.ablation.thesis_sectors import sector_errors
from validation.errors import ValidationError
from validation.mapping.rays import rays
from validation.metrics.statistics import largest, rms
from validation.reference.generated import check_stated
from validation.reference.kind import Reference
from validation.reference.kinds import kind_of
from validation.runs.output import MARK, write_json
from validation.runs.reduced_model import run_reduced_model
from validation.runs.variants import Watch


def ablation_row(
    variant: str, model: str, case: Case, reference: Reference, table: Path | None
) -> AblationRow:
    """Run one model and compare it."""
    grid = grid_of(case)
    begin = time.process_time()
    try:
        run = run_reduced_model(case, reference.alignment, rays(grid.x, grid.phi)).fields
    except SolverError as error:
        spent = time.process_time() - begin
        return AblationRow(variant, model, **dict.fromkeys(MEASURES), run_s=spent, failure=str(error))
    spent = time.process_time() - begin

    def relative(name: str, over: str | None = None) -> Floats:
        one, other = run[name], reference.fields[name]
        if over is not None:
            one, other = one / run[over], other / reference.fields[over]
        return np.asarray((one.to_numpy() - other.to_numpy()) / other.to_numpy())

    radius, share = relative("radius"), relative("sector_flow_rate", "section_flow_rate")
    has_table = table is not None and isinstance(case.calcification, LocalCalcification)
    return AblationRow(
        variant,
        model,
        radius_rms=rms(radius),
        radius_max=largest(radius),
        pressure_rms=rms(relative("pressure")),
        section_flow_rms=rms(relative("section_flow_rate")),
        sector_share_rms=rms(share),
        sector_share_max=largest(share),
        thesis_sector_max=largest(sector_errors(case, table)) if table is not None and has_table else None,
        run_s=round(spent, 3),
        failure="",
    )


def ablation_rows(file: CaseFile, table: Path | None, watch: Watch) -> Iterator[AblationRow]:
    """All models of all variants.

    Raises
    ------
    ValidationError
        If a variant states no reference; else as the readers raise.
    """
    check_stated(file)
    for variant, case in file.variants.items():
        models = models_between(case)
        grid = grid_of(case)
        with watch.step(f"{variant}: 3D onto cells") as progress:
            reference = kind_of(variant, case).read(case, rays(grid.x, grid.phi), progress, None)
        for model, changed in models.items():
            with watch.step(f"{variant}: {model}"):
                yield ablation_row(variant, model, changed, reference, table)


def write_rows(directory: Path, rows: list[AblationRow]) -> None:
    """Write ablation.csv and ablation.json, each whole or not at all; draw a finished comparison again.

    Raises
    ------
    ValidationError
        If they cannot be written.
    ReportError
        If the directory holds a comparison that is damaged.
    """
    records = [asdict(row) for row in rows]
    with writing(directory, ValidationError):
        directory.mkdir(parents=True, exist_ok=True)
        write_text(directory / "ablation.csv", pd.DataFrame(records).to_csv(index=False))
        write_json(directory / "ablation.json", records)
    if (directory / MARK).is_file():
        write_reports(directory)


def printed(rows: list[AblationRow]) -> Table:
    """Rows as a table for a terminal."""
    table = Table(title="Errors against 3D")
    for heading in ("variant", "model", *(each.heading for each in MEASURES.values()), "run"):
        table.add_column(heading, no_wrap=heading == "model")
    for row in rows:
        values = [getattr(row, name) for name in MEASURES]
        texts = ["" if value is None else f"{100 * value:+.2f} %" for value in values]
        table.add_row(
            row.variant, row.model, *(texts if not row.failure else [row.failure]), f"{row.run_s:.2f} s"
        )
    return table

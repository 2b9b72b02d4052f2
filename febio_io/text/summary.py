"""What a log or a data record tells, as plain data and as text."""

from collections.abc import Iterator
from math import isfinite
from typing import Any

from febio_io.text.data_records import DataRecord
from febio_io.text.log import Log

Summary = dict[str, Any]
ENDS = {
    "normal": "normally",
    "error": "with an error",
    "none": "not said: the run was killed, crashed or goes on",
}


def summarize_log(log: Log) -> Summary:
    """Describe a log in values that JSON can hold."""
    return {
        "path": str(log.path),
        "kind": "log",
        "version": log.version,
        "files": log.files,
        "termination": log.termination,
        "analysis_steps": log.time_steps[-1].analysis_step if log.time_steps else 0,
        "attempts": len(log.time_steps),
        "converged": log.n_converged,
        "retries": log.n_retries,
        "iterations": log.n_iterations,
        "last_time": _finite(log.time_steps[-1].time) if log.time_steps else None,
        "equations": log.n_equations,
        "nonzeros": log.n_nonzeros,
        "timings": {label: _finite(seconds) for label, seconds in log.timings.items()},
        "peak_memory_megabytes": None if log.peak_memory is None else _finite(log.peak_memory),
        "messages": [vars(message) for message in log.messages],
        "records": [
            {"number": item.number, "name": item.name, "file": item.file, "blocks": len(item.blocks)}
            for item in log.records
        ],
    }


def _finite(value: float) -> float | None:
    """JSON has no other numbers."""
    return value if isfinite(value) else None


def log_lines(summary: Summary) -> Iterator[str]:
    """Write a log's summary for people, line by line."""
    yield f"{summary['path']}: FEBio log, version {summary['version'] or 'not said'}"
    for what, name in summary["files"].items():
        yield f"  {what.lower():12} {name}"
    yield f"  ended        {ENDS[summary['termination']]}"
    yield (
        f"  time steps   {summary['converged']} converged, {summary['retries']} retries, "
        f"{summary['iterations']} iterations, {summary['analysis_steps']} analysis steps"
    )
    if summary["equations"] is not None:
        nonzeros = summary["nonzeros"] if summary["nonzeros"] is not None else "not said how many"
        yield f"  equations    {summary['equations']}, nonzeros {nonzeros}"
    for label in ("Solve time", "Total elapsed time"):
        if summary["timings"].get(label) is not None:
            yield f"  {label.lower():20} {summary['timings'][label]:.6g} s"
    for message, count, line in _counted(summary["messages"]):
        times = f"{count} times, first in" if count > 1 else "in"
        yield f"  {message} ({times} line {line})"
    for record in summary["records"]:
        where = f"in {record['file']}" if record["file"] else "in this file"
        yield f"  data record {record['number']} {record['name']!r}: {record['blocks']} blocks, {where}"


def _counted(messages: list[Summary]) -> list[tuple[str, int, int]]:
    found: dict[str, tuple[int, int]] = {}
    for message in messages:
        text = f"{message['kind']}: {message['text']}"
        count, line = found.get(text, (0, message["line"]))
        found[text] = (count + 1, line)
    return [(text, count, line) for text, (count, line) in found.items()]


def summarize_record(record: DataRecord) -> Summary:
    """Describe a data record in values that JSON can hold."""
    return {
        "path": str(record.path),
        "kind": "data record",
        "name": record.name,
        "columns": [
            {"name": column, "unit": unit} for column, unit in zip(record.columns, record.units, strict=True)
        ],
        "blocks": len(record.times),
        "times": [_finite(time) for time in record.times.tolist()],
        "rows": len(record.items),
        "regular": record.is_regular,
        "warnings": list(record.warnings),
    }


def record_lines(summary: Summary) -> Iterator[str]:
    """Write a data record's summary for people, line by line."""
    times = [time for time in summary["times"] if time is not None]
    span = f", time {times[0]:g} to {times[-1]:g}" if times else ", times not said"
    yield f"{summary['path']}: FEBio data record {summary['name']!r}"
    yield f"  blocks       {summary['blocks']}{span}"
    alike = "the same items in each" if summary["regular"] else "not the same items in each"
    yield f"  rows         {summary['rows']}, {alike}"
    columns = [item["name"] + (f" [{item['unit']}]" if item["unit"] else "") for item in summary["columns"]]
    yield f"  columns      {', '.join(columns) or 'none'}"
    for warning in summary["warnings"]:
        yield f"  warning      {warning}"

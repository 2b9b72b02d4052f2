"""Tasks for workers of real clusters: one that dies, one that raises."""

import os
import time

from validation.sweep.chunk import Plan, Record
from validation.sweep.samples import Sample


def record(sample: Sample) -> Record:
    return {"sample": sample.number, "status": "ok", "error": None}


def dies_with_the_third(samples: list[Sample], _plan: Plan) -> list[Record]:
    if any(sample.number == 2 for sample in samples):
        time.sleep(0.5)  # so that its nanny has seen it alive
        os._exit(9)
    return [record(sample) for sample in samples]


def raises_with_the_third(samples: list[Sample], _plan: Plan) -> list[Record]:
    if any(sample.number == 2 for sample in samples):
        raise ZeroDivisionError("float division by zero")
    return [record(sample) for sample in samples]

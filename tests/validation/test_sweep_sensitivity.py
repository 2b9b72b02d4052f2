"""Sobol indices against a function whose indices are known."""

import numpy as np
import pytest
from small_sweep import small_study

from validation.sweep.folder import part_path, schema_of, write_part
from validation.sweep.samples import samples_of_study
from validation.sweep.sensitivity import sensitivity, whole_groups

PARAMETERS = {
    "inlet.scale": {"distribution": "uniform", "low": 0.9, "high": 1.1},
    "outlet.offset": {"distribution": "uniform", "low": "9000 Pa", "high": "9200 Pa"},
}
OUTPUTS = ["flow_amplitude", "largest_radius", "least_radius"]


def recorded(folder, failing=()):
    """A study whose outputs are an additive function, a constant, and nothing."""
    design = {"kind": "saltelli", "count": 256, "seed": 2}
    study = small_study(folder, parameters=PARAMETERS, design=design, outputs=OUTPUTS)
    samples = samples_of_study(study)
    (folder / "samples").mkdir()
    rows = []
    for number in range(len(samples)):
        scale, offset = samples.points[number].tolist()
        value = 3.0 * (scale - 1.0) / 0.1 + (offset - 9100.0) / 100.0
        lost = number in failing
        about = {"sample": number, "variant": "local", "status": "failed" if lost else "ok"}
        rows.append(about | {"flow_amplitude": None if lost else value, "largest_radius": 1.0})
    write_part(part_path(folder, 0), rows, schema_of(PARAMETERS, OUTPUTS))
    return study


def of(found, output, name):
    return [getattr(row, name) for row in found if row.output == output]


@pytest.mark.parametrize("failing", [(), (0, 5, 6, 100)])
def test_indices_of_an_additive_function(tmp_path, failing):
    found = sensitivity(recorded(tmp_path, failing), tmp_path)
    assert [row.parameter for row in found] == list(PARAMETERS) * 3
    for name in ("S1", "ST"):
        indices = np.array(of(found, "flow_amplitude", name))
        intervals = np.array(of(found, "flow_amplitude", f"{name}_conf"))
        assert np.all(intervals < 0.2)
        assert np.all(np.abs(indices - [0.9, 0.1]) < np.maximum(intervals, 0.02))
    assert of(found, "flow_amplitude", "groups") == [256 - len({number // 4 for number in failing})] * 2


def test_what_does_not_vary_or_has_no_value_has_no_indices(tmp_path):
    found = sensitivity(recorded(tmp_path), tmp_path)
    for output in ("largest_radius", "least_radius"):
        assert of(found, output, "S1") == of(found, output, "ST_conf") == [None, None]


def test_groups_with_a_failure_are_left_out():
    values = np.arange(12.0)
    values[5] = np.nan
    assert whole_groups(values, 2).tolist() == [[0, 1, 2, 3], [8, 9, 10, 11]]


def test_other_designs_have_no_indices(tmp_path):
    assert sensitivity(small_study(tmp_path), tmp_path) is None

"""`python -m validation.compare`: Ctrl-C and signals leave nothing."""

import os
import signal
import subprocess
import sys
import time

import pytest
from small_case import ROOT, bands, small_case, written

from validation.compare import case as comparing
from validation.compare import command as compare
from validation.runs import cached as cached_runs
from validation.runs import output


def interrupt(*_arguments, **_options):
    raise KeyboardInterrupt


class TestInterrupt:
    @pytest.mark.parametrize(
        ("module", "name"),
        [
            (cached_runs, "run_reduced_model"),
            (comparing, "all_models"),
            (comparing, "comparison_file"),
            (comparing, "write_walls"),
            (comparing, "write_reports"),
        ],
    )
    def test_nothing_is_left(self, tmp_path, capsys, monkeypatch, module, name, made):
        monkeypatch.setattr(module, name, interrupt)
        path = written(made(), tmp_path)
        old = tmp_path / "result"
        old.mkdir()
        (old / output.MARK).write_text("{}")
        assert compare.main([str(path), "--output", str(old)]) == 130
        assert capsys.readouterr().err == "interrupted; no result was written\n"
        assert {item.name for item in tmp_path.iterdir()} == {path.name, "result"}
        assert [item.name for item in old.iterdir()] == [output.MARK]

    @pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
    def test_a_signal_while_it_runs(self, tmp_path):
        case = bands(small_case("none", "axisymmetric", "local"))
        case["solver"] |= {"time_step": "1 ms", "cycles": 30}
        path, result = written(case, tmp_path), tmp_path / "out" / "result"
        result.parent.mkdir()
        command = [sys.executable, "-m", "validation.compare", str(path), "--output", str(result)]
        with subprocess.Popen(  # noqa: S603
            command,
            cwd=ROOT,
            stderr=subprocess.PIPE,
            text=True,
            # a test run in the background ignores the signal, and so would its children
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        ) as process:
            while process.poll() is None and not any(result.parent.iterdir()):
                time.sleep(0.02)
            process.send_signal(signal.SIGINT)
            _, err = process.communicate(timeout=120)
        assert (process.returncode, err) == (130, "interrupted; no result was written\n")
        assert list(result.parent.iterdir()) == []

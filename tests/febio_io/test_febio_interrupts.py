"""Ctrl-C is held back where others' code would break, and never lost."""

import os
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from xplt_samples import sample_file

from cases.shell.interrupts import interrupts_deferred, interrupts_told_to

ROOT = Path(__file__).parents[2]
# Interrupts itself when a compiled module of VTK is about to be imported, i.e. within the import of another.
INTERRUPTED = """
import os, signal, sys

module = sys.argv.pop(1)

def interrupt(event, arguments):
    if event == "import" and arguments[0] == module:
        os.kill(os.getpid(), signal.SIGINT)

sys.addaudithook(interrupt)
from cases.shell.command import run
sys.exit(run("febio_io.command"))
"""


def interrupted(done):
    with interrupts_deferred():
        signal.raise_signal(signal.SIGINT)
        done()


def test_an_interrupt_is_raised_when_the_block_has_ended():
    done = []
    with pytest.raises(KeyboardInterrupt):
        interrupted(lambda: done.append(1))
    assert done == [1]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_error_of_the_block_comes_first():
    with pytest.raises(ZeroDivisionError):
        interrupted(lambda: 1 / 0)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_each_interrupt_is_told():
    told = []
    with interrupts_told_to(told.append):
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
    assert told == [signal.SIGINT, signal.SIGINT]


def test_other_threads_run_as_they_are():
    done = []

    def work():
        with interrupts_deferred():
            done.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert done == [signal.default_int_handler]


@pytest.mark.parametrize(
    "module", ["numpy._core._multiarray_umath", "vtkmodules.vtkCommonCore", "vtkmodules.vtkFiltersCore"]
)
def test_an_interrupted_import_ends_the_command_cleanly(write, tmp_path, module):
    command = [sys.executable, "-c", INTERRUPTED, module, str(write(sample_file()))]
    command += ["--export", str(tmp_path / "out"), "--format", "vtkhdf"]
    result = subprocess.run(  # noqa: S603
        command,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    assert (result.returncode, result.stdout) == (130, "")
    assert result.stderr in ("", "interrupted; no file was written\n")
    assert not (tmp_path / "out").exists()

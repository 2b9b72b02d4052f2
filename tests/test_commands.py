"""All commands start and end alike, under their own name and under that of `arterial-rom`."""

import os
import re
import signal
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from cases.errors import CaseError
from cases.shell.command import concluded, run
from cases.shell.errors import InputError
from febio_io.errors import FebioError
from reports.errors import ReportError
from solver.errors import SolverError
from validation.__main__ import COMMANDS, main
from validation.errors import ValidationError

ROOT = Path(__file__).parents[1]
NOTHING = "interrupted; no result was written"
# Sends itself a signal when a module is looked for.
INTERRUPTED = """
import os, runpy, signal, sys

package, module, number, *sys.argv[1:] = sys.argv[1:]

class Interrupt:
    def find_spec(name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), int(number))

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupt)
runpy.run_module(package, run_name="__main__", alter_sys=True)
"""


def python(*arguments, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(  # noqa: S603
        [sys.executable, *arguments], capture_output=True, text=True, check=False, env=environment, **options
    )


@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"]])
def test_every_command_is_listed_in_a_line(capsys, arguments):
    assert main(arguments) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "usage: arterial-rom NAME …"
    assert [line.split()[0] for line in lines[2:-2]] == list(COMMANDS)


@pytest.mark.parametrize(
    ("name", "nearest"), [("comapre", "compare"), ("reports", "report"), ("run", "run-febio"), ("?", None)]
)
def test_an_unknown_name_suggests_the_nearest(capsys, name, nearest):
    assert main([name]) == 2
    said = capsys.readouterr()
    assert (said.out, said.err.count("\n")) == ("", 1)
    assert f"no command {name!r}; the nearest is " in said.err
    assert nearest is None or f"is {nearest!r}, " in said.err


def test_every_command_of_a_package_is_there():
    found = {
        ".".join(path.parent.relative_to(ROOT).parts)
        for package in ("cases", "solver", "febio_io", "validation", "reports")
        for path in (ROOT / package).rglob("__main__.py")
    }
    assert found - {"validation"} == {package for package, _ in COMMANDS.values()}


@pytest.mark.parametrize("name", COMMANDS)
def test_help_names_what_was_called(name, capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["", "--help"])
    before = signal.getsignal(signal.SIGTERM)
    package = COMMANDS[name][0]
    try:
        for call, called in (
            (lambda: main([name, "--help"]), f"arterial-rom {name}"),
            (lambda: run(f"{package}.command"), f"python -m {package}"),
        ):
            with pytest.raises(SystemExit) as stop:
                call()
            assert stop.value.code == 0
            assert capsys.readouterr().out.startswith(f"usage: {called} ")
    finally:
        signal.signal(signal.SIGTERM, before)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("package", "module", "number", "said"),
    [
        ("cases", "cases.command", signal.SIGTERM, ""),
        ("cases", "pydantic", signal.SIGTERM, "interrupted\n"),
        ("validation.converge", "numba", signal.SIGINT, NOTHING + "\n"),
        ("febio_io.feb", "febio_io.feb.command", signal.SIGTERM, ""),
        (
            "validation.compare",
            "validation.compare.outcome",
            signal.SIGTERM,
            "interrupted; no result was written\n",
        ),
        ("reports", "matplotlib", signal.SIGINT, "reports: interrupted\n"),
    ],
)
def test_an_interrupt_while_modules_load_is_a_line_at_most(package, module, number, said):
    done = python("-c", INTERRUPTED, package, module, str(int(number)), "absent")
    assert (done.returncode, done.stdout, done.stderr) == (130, "", said)


LIBRARIES = ("dask", "matplotlib", "numba", "numpy", "pandas", "pint", "pyvista", "rich", "scipy", "xarray")
HELP = """
import sys
from importlib import import_module

for package in {packages}:
    try:
        import_module(package + ".command").main(["--help"])
    except SystemExit:
        print(package, *sorted(set(sys.modules) & {libraries}), file=sys.stderr)
"""


def test_help_of_no_command_loads_a_library_that_is_slow_to_load():
    light = [package for package, _ in COMMANDS.values() if not package.startswith("febio_io")]
    packages = [*light, "febio_io", "febio_io.run", "febio_io.feb"]  # which are made of NumPy's types
    done = python("-c", HELP.format(packages=packages, libraries=set(LIBRARIES)))
    loaded = dict.fromkeys(light, "") | dict.fromkeys(packages[len(light) :], " numpy")
    assert done.stderr.splitlines() == [package + libraries for package, libraries in loaded.items()]


def test_a_check_of_a_case_loads_no_library_that_is_slow_to_load():
    code = (
        f"import sys, cases.command as c; c.main(sys.argv[1:]); print(*set(sys.modules) & {set(LIBRARIES)})"
    )
    names = ("calcification", "boileau_uta", "solid")
    done = python("-c", code, *(str(ROOT / f"cases/{name}.yaml") for name in names))
    assert done.stderr == ""
    assert len(done.stdout.splitlines()) > 3
    assert done.stdout.splitlines()[-1] == ""


def test_a_comparison_loads_no_library_before_it_is_used():
    late = {"dask", "matplotlib", "pint", "pyvista", "scipy.interpolate", "scipy.optimize", "scipy.stats"}
    code = f"import sys, validation.compare.case; print(*sorted(set(sys.modules) & {late}))"
    assert python("-c", code).stdout == "\n"


def test_a_closed_pipe_ends_quietly(tmp_path):
    names = [str(ROOT / "cases/calcification.yaml")] * 2
    with subprocess.Popen(  # noqa: S603
        [sys.executable, "-m", "cases", *names], cwd=ROOT, stdout=-1, stderr=-1, text=True
    ) as command:
        command.stdout.close()
        errors = command.stderr.read()
    assert (command.returncode, errors) == (1, "")


@pytest.mark.parametrize("kind", [CaseError, FebioError, ReportError, SolverError, ValidationError])
def test_errors_of_every_package_are_one_message(capsys, kind):
    def fail():
        raise kind("file: what is wrong")

    assert issubclass(kind, InputError)
    assert concluded(fail, prefix="name: ") == 2
    assert capsys.readouterr().err == "name: file: what is wrong\n"


def test_what_nobody_expected_is_no_message():
    with pytest.raises(ZeroDivisionError):
        concluded(lambda: 1 // 0)


@pytest.mark.parametrize("told", ["stopped; go on", lambda: "stopped; go on"])
def test_an_interrupt_is_told_in_a_line(capsys, told):
    def interrupted():
        raise KeyboardInterrupt

    assert concluded(interrupted, told) == 130
    assert capsys.readouterr().err == "stopped; go on\n"


def test_the_script_is_declared():
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    (module, function) = re.search(r'^arterial-rom = "(.+):(.+)"$', text, re.MULTILINE).groups()
    assert getattr(import_module(module), function) is main

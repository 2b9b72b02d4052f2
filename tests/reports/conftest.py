import json
import os
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from functools import cache
from pathlib import Path
from typing import Any

import chromium
import pytest
import synthetic_comparison as synthetic
from pdf_words import words_of_pages
from playwright.sync_api import Browser, sync_playwright

from reports import build
from reports.build import write_reports
from reports.sweep import build as sweep_build


@pytest.fixture(scope="session")
def pdf_pages() -> Callable[[Path], list[str]]:
    """Text of each page of a PDF with single spaces between words."""

    texts = cache(words_of_pages)
    return lambda path: texts(path.read_bytes())


@pytest.fixture(scope="session")
def pdf_text(pdf_pages: Callable[[Path], list[str]]) -> Callable[[Path], str]:
    """Text of a PDF with single spaces between words."""
    return lambda path: " ".join(pdf_pages(path))


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """Chromium that draws WebGL by software."""
    found = chromium.find()
    with sync_playwright() as playwright:
        launched = playwright.chromium.launch(
            executable_path=found.executable, args=chromium.ARGUMENTS, env=found.environment()
        )
        yield launched
        launched.close()


def _written(
    factory: pytest.TempPathFactory, name: str, setup: synthetic.Setup, models: tuple[str, ...]
) -> tuple[Path, list[dict[str, Any]]]:
    """Directory of a comparison with its reports, and its metrics; of two processes the first writes it."""
    base = factory.getbasetemp()
    shared = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / name
    if not shared.exists():
        own = factory.mktemp(name)
        synthetic.write(own, setup, models)
        write_reports(own)
        try:
            own.rename(shared)
        except OSError:  # the other process was faster, and its reports are as good
            if not shared.exists():
                raise
    return shared, json.loads((shared / "metrics.json").read_text())


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[dict[str, Any]]]:
    """Directory of a comparison of three variants with its reports written, and its metrics."""
    return _written(tmp_path_factory, "comparison", synthetic.Setup(i=(1, 6, 12), j=(1, 4)), ("rom",))


def _limit(quantity: str, limit: float, *variants: str, statistic: str = "rms_error") -> dict[str, Any]:
    about = {"quantity": quantity, "statistic": statistic, "limit": limit, "reason": "synthetic"}
    return about | {"variants": list(variants or synthetic.VARIANTS)}


@pytest.fixture(scope="session")
def two_models(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[dict[str, Any]]]:
    """Directory of a comparison of two reduced models with its reports written, and its metrics.

    Of the limits, some are held by the one, the other, both or neither.
    """
    bands = [
        _limit("section_flow_rate", 0.04),
        _limit("radius", 0.005),
        _limit("largest_pressure_difference", 0.147, "local", statistic="cycle"),
    ]
    setup = synthetic.Setup(n_x=6, n_y=7, i=(1, 3, 6), j=(1, 4), bands=bands, budget=True, costs=True)
    return _written(tmp_path_factory, "two models", setup, ("row", "coupled"))


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports get an empty drawing for every figure: for tests of what is not drawn."""
    blank = '<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" width="9pt" height="9pt"></svg>'
    for module in (build, sweep_build):
        monkeypatch.setattr(module, "draw", lambda drawings, _: dict.fromkeys(drawings, blank))
    monkeypatch.setattr(build, "helper", nullcontext)


@pytest.fixture
def small() -> synthetic.Setup:
    """The smallest comparison: one variant, one cell, one instant, no baseline."""
    return synthetic.Setup(variants=("local",), baseline="", i=(6,), j=(4,), time_names=("systole",))

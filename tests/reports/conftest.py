import io
import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import chromium
import pypdf
import pytest
import synthetic_comparison as synthetic
from playwright.sync_api import Browser, sync_playwright

from reports import build
from reports.build import write_reports


@pytest.fixture(scope="session")
def pdf_pages() -> Callable[[Path], list[str]]:
    """Text of each page of a PDF with single spaces between words."""

    @cache
    def texts(content: bytes) -> list[str]:
        pages = pypdf.PdfReader(io.BytesIO(content)).pages
        return [re.sub(r"\s+", " ", page.extract_text()) for page in pages]

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


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[dict[str, Any]]]:
    """Directory of a comparison of three variants with its reports written, and its metrics."""
    directory = tmp_path_factory.mktemp("comparison")
    rows = synthetic.write(directory, synthetic.Setup(i=(1, 6, 12), j=(1, 4)))
    write_reports(directory)
    return directory, rows


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
    directory = tmp_path_factory.mktemp("two models")
    rows = synthetic.write(directory, setup, ("row", "coupled"))
    write_reports(directory)
    return directory, rows


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """Reports get an empty drawing for every figure: for tests of what is not drawn."""
    blank = '<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg" width="9pt" height="9pt"></svg>'
    monkeypatch.setattr(build, "draw", lambda drawings, _: dict.fromkeys(drawings, blank))


@pytest.fixture
def small() -> synthetic.Setup:
    """The smallest comparison: one variant, one cell, one instant, no baseline."""
    return synthetic.Setup(variants=("local",), baseline="", i=(6,), j=(4,), time_names=("systole",))

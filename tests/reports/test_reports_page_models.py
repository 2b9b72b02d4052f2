"""The page of a comparison of several reduced models in a real browser."""

from pathlib import Path

import numpy as np
import synthetic_comparison as synthetic
import xarray as xr
from opened_page import WIDE, open_page
from playwright.sync_api import Browser

from reports.build import write_reports


def test_the_chosen_model_is_what_all_pictures_compare(
    browser: Browser, tmp_path: Path, small: synthetic.Setup, undrawn: None
) -> None:
    synthetic.write(tmp_path, small, ("row", "coupled"))
    write_reports(tmp_path)
    one = open_page(browser, tmp_path / "report.html", viewport=WIDE, bypass_csp=True)
    page = one.page
    for model in ("coupled", "row"):
        page.locator("#choice").get_by_label("2D model").select_option(label=model)
        for key in ("curves-anywhere", "maps-anytime", "artery-turned", "profiles-anytime"):
            page.locator(f"#{key}").scroll_into_view_if_needed()
            page.wait_for_function(
                "([key, model]) => document.querySelector(`#${key} .readout`).textContent.includes(model)",
                arg=[key, model],
            )
        drawn = page.evaluate(
            "document.querySelector('#curves-anywhere .plot').drawn.map((line) => [line.name, [...line.y]])"
        )
        assert [name for name, _ in drawn] == ["3D", model, f"{model} − 3D"]
        with xr.open_dataset(tmp_path / "comparison.nc", decode_times=False) as data:
            radius = 1e3 * data[f"{model}_radius"].isel(variant=0, x=5, phi=3).values
        np.testing.assert_allclose(drawn[1][1], radius, atol=2e-4)
        page.wait_for_function("(model) => location.hash.includes(`model=${model}`)", arg=model)
    assert one.console == []
    page.context.close()

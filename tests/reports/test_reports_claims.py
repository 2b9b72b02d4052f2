"""What the PDF says in words, held against the figures that it was made from."""

import io
import json
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import synthetic_comparison as synthetic
import typst
import xarray as xr

from cases.fields import FIELDS
from reports.figures.two_processes import draw
from reports.pdf.render import render_pdf
from reports.result.load import load
from reports.sections import cycle
from reports.sections.content import report
from reports.wording.numbers import DIFFERENCE_UNITS

Finished = tuple[Path, list[dict[str, Any]]]
CLAIM = re.compile(
    r"(?P<label>[a-z][a-z –-]*?) (?P<value>[+−]?[\d.]+)(?: (?P<unit>Pa|μm|mm³/s|mm/s))? "
    r"\(i = (?P<i>\d+)(?:, j = (?P<j>\d+))?(?:, t = (?P<t>[\d.]+) s)?\)"
)
LABELS = {field.label: field for field in FIELDS.values() if field.dims}


@pytest.fixture(scope="module")
def captions(finished: Finished, pdf_text: Callable[[Path], str]) -> list[str]:
    """Captions of the PDF's figures, as a reader finds them."""
    text = pdf_text(finished[0] / "report.pdf").replace("\u00a0", " ")
    found = re.findall(r"Figure \d+\. (.*?) Data: attached file", text)
    assert len(found) == len(list(report(load(finished[0])).figures()))
    return found


@pytest.fixture(scope="module")
def data(finished: Finished) -> Iterator[xr.Dataset]:
    """Both models' fields."""
    with xr.open_dataset(finished[0] / "comparison.nc", decode_times=False) as opened:
        yield opened.load()


def _number(text: str) -> float:
    return float(text.replace("−", "-"))


def _claims(caption: str) -> list[re.Match[str]]:
    return list(CLAIM.finditer(caption.partition("Farthest apart: ")[2].partition(". ")[0] + "."))


def test_each_figure_of_curves_and_maps_claims_what_the_models_say(
    captions: list[str], data: xr.Dataset, finished: Finished
) -> None:
    named = {t: k for k, t in enumerate(data.attrs["compare_times_s"].tolist())}
    held_against_metrics = 0
    compared = [caption for caption in captions if "Farthest apart" in caption]
    assert len(compared) >= 2 * len(synthetic.VARIANTS)  # curves and maps
    for caption in compared:
        variant = re.match(r"Variant (\w+)", caption)
        assert variant
        local = data.sel(variant=variant[1])
        claims = _claims(caption)
        assert claims, caption
        for claim in claims:
            label = next(label for label in LABELS if claim["label"].strip().endswith(label))
            field = LABELS[label]
            difference = local[f"rom_{field.name}"] - local[f"reference_{field.name}"]
            factor = DIFFERENCE_UNITS[field.unit][1]
            assert (claim["unit"] or "") == DIFFERENCE_UNITS[field.unit][0]
            t = float(claim["t"]) if claim["t"] else min(named)
            at = {"x": int(claim["i"]) - 1, **({"phi": int(claim["j"]) - 1} if claim["j"] else {})}
            there = factor * float(difference.isel(at).sel(time=t, method="nearest"))
            assert _number(claim["value"]) == pytest.approx(there, rel=6e-3)
            for row in finished[1]:
                same = (row["variant"], row["quantity"], row["statistic"]) == (
                    variant[1],
                    field.name,
                    "value",
                )
                place = (row["i"], row["j"]) == (int(claim["i"]), int(claim["j"]) if claim["j"] else None)
                if same and place and abs(row["t_s"] - t) < 1e-3:
                    stated = factor * (row["rom"] - row["reference"])
                    assert _number(claim["value"]) == pytest.approx(stated, rel=6e-3)
                    held_against_metrics += 1
    assert held_against_metrics >= 4


def test_the_maps_claim_is_the_largest_of_all_cells(captions: list[str], data: xr.Dataset) -> None:
    found = [caption for caption in captions if "over the unrolled lumen" in caption]
    assert len(found) == len(synthetic.VARIANTS)
    state = int(np.abs(data["time"].values - data.attrs["compare_times_s"][0]).argmin())
    for variant, caption in zip(synthetic.VARIANTS, found, strict=True):
        now = data.sel(variant=variant).isel(time=state)
        for claim in _claims(caption):
            field = LABELS[next(label for label in LABELS if claim["label"].strip().endswith(label))]
            difference = np.abs(now[f"rom_{field.name}"] - now[f"reference_{field.name}"]).values
            largest = DIFFERENCE_UNITS[field.unit][1] * difference.max()
            assert abs(_number(claim["value"])) == pytest.approx(largest, rel=6e-3)


def test_the_exponents_claim_is_that_of_the_metrics(captions: list[str], data: xr.Dataset) -> None:
    found = [caption for caption in captions if "exponent γ of the profile closest to 3D" in caption]
    times = [int(np.abs(data["time"].values - t).argmin()) for t in data.attrs["compare_times_s"]]
    for variant, caption in zip(synthetic.VARIANTS, found, strict=True):
        spans = re.search(r"γ is ([\d.]+) … ([\d.]+) in 3D and ([\d.]+) … ([\d.]+) in 2D", caption)
        assert spans
        for model, texts in (("reference", spans.groups()[:2]), ("rom", spans.groups()[2:])):
            values = data[f"{model}_profile_exponent"].sel(variant=variant).isel(time=times)
            assert [float(text) for text in texts] == pytest.approx(
                [float(values.min()), float(values.max())], abs=5.1e-3
            )


def test_the_stills_claim_is_the_narrowest_place(captions: list[str], data: xr.Dataset) -> None:
    (caption,) = (caption for caption in captions if "The deformed lumen" in caption)
    state = int(np.abs(data["time"].values - data.attrs["compare_times_s"][0]).argmin())
    for variant in synthetic.VARIANTS:
        said = re.search(
            variant + r": ([\d.]+) mm in 3D \(i = (\d+), j = (\d+)\) and ([\d.]+) mm in 2D", caption
        )
        assert said
        radius = 1e3 * data["reference_radius"].sel(variant=variant).isel(time=state)
        assert float(said[1]) == pytest.approx(float(radius.min()), abs=5.1e-4)
        assert float(radius[int(said[2]) - 1, int(said[3]) - 1]) == pytest.approx(float(radius.min()))
        rom = 1e3 * data["rom_radius"].sel(variant=variant).isel(time=state)
        assert float(said[4]) == pytest.approx(float(rom.min()), abs=5.1e-4)


def test_the_verdict_is_that_of_the_bands(finished: Finished, pdf_text: Callable[[Path], str]) -> None:
    text = pdf_text(finished[0] / "report.pdf").replace("\u00a0", " ")
    for row in finished[1]:
        if row["status"] == "FAIL":
            assert f"{100 * row['error']:.2f} %, limit {100 * row['band']:g} %".replace("-", "−") in text
    assert "What this comparison does not tell" in text
    assert "1 band could not be judged" in text
    assert "whether 3D had become periodic by then is not measured" in text


def _shown(caption: str, variant: str, rows: list[dict[str, Any]], quantity: str) -> list[dict[str, Any]]:
    """Rows of metrics.json at the cells and instants that a caption names."""
    named = {float(t) for t in re.findall(r"\(([\d.]+) s\)", caption)}
    cells = re.search(r"at cells i = ([\d, and]+?), j = ([\d, and]+)", caption)
    assert cells
    i, j = ({int(n) for n in re.findall(r"\d+", words)} for words in cells.groups())
    return [
        row
        for row in rows
        if (row["variant"], row["quantity"], row["statistic"]) == (variant, quantity, "value")
        and row["i"] in i
        and row["j"] in j
        and any(abs(row["t_s"] - t) < 6e-4 for t in named)
    ]


def _span(text: str) -> list[float]:
    low, _, high = text.partition(" … ")
    return [float(low), float(high or low)]


def test_the_profiles_claims_are_those_of_the_metrics_and_the_models(
    captions: list[str], data: xr.Dataset, finished: Finished
) -> None:
    found = [caption for caption in captions if "axial velocity along the ray" in caption]
    assert len(found) > len(synthetic.VARIANTS)
    for caption in found:
        variant = caption.split()[1].rstrip(",")
        rows = _shown(caption, variant, finished[1], "profile_exponent")
        said = re.search(r"is ([\d.]+(?: … [\d.]+)?) in 3D and ([\d.]+(?: … [\d.]+)?) in 2D", caption)
        assert said
        for text, model in zip(said.groups(), ("reference", "rom"), strict=True):
            values = [row[model] for row in rows]
            assert _span(text) == pytest.approx([min(values), max(values)], abs=5.1e-3)
        farthest = re.search(
            r"2D − 3D = ([+−][\d.]+) (cm/s|mm/s), at r/R = ([\d.]+) \(i = (\d+), j = (\d+), t = ([\d.]+) s\)",
            caption,
        )
        assert farthest
        value, unit, y, i, j, t = farthest.groups()
        local = data.sel(variant=variant)
        ray = (local["rom_axial_velocity"] - local["reference_axial_velocity"]).isel(
            x=int(i) - 1, phi=int(j) - 1
        )
        there = ray.sel(time=float(t), y=float(y), method="nearest")
        factor = {"cm/s": 1e2, "mm/s": 1e3}[unit]
        assert _number(value) == pytest.approx(factor * float(there), rel=6e-3)
        places = [(row["t_s"], row["i"] - 1, row["j"] - 1) for row in rows]
        all_rays = local["rom_axial_velocity"] - local["reference_axial_velocity"]
        largest = max(
            float(np.abs(all_rays.sel(time=t_s, method="nearest").isel(x=a, phi=b)).max())
            for t_s, a, b in places
        )
        assert abs(_number(value)) == pytest.approx(factor * largest, rel=6e-3)


def test_the_error_curves_claims_are_those_of_the_metrics(
    captions: list[str], data: xr.Dataset, finished: Finished
) -> None:
    found = [caption for caption in captions if "relative error of the profile with exponent" in caption]
    assert len(found) == len(synthetic.VARIANTS)
    for caption in found:
        variant = caption.split()[1].rstrip(",")
        rows = _shown(caption, variant, finished[1], "profile_error")
        off = re.search(r"is off 3D by ([\d.]+) % to ([\d.]+) %", caption)
        assert off
        best = [100 * row["reference"] for row in rows]
        assert [float(text) for text in off.groups()] == pytest.approx([min(best), max(best)], abs=5.1e-3)
        most = re.search(
            r"costs most at i = (\d+), j = (\d+), t = ([\d.]+) s: an error of ([\d.]+) % where ([\d.]+) %",
            caption,
        )
        assert most
        worst = max(rows, key=lambda row: row["rom"] - row["reference"])
        assert (int(most[1]), int(most[2])) == (worst["i"], worst["j"])
        assert float(most[4]) == pytest.approx(100 * worst["rom"], abs=5.1e-3)
        assert float(most[5]) == pytest.approx(100 * worst["reference"], abs=5.1e-3)
        curves = data["reference_profile_error_curve"].sel(variant=variant)
        assert 100 * float(curves.min()) == pytest.approx(min(best), abs=0.05)


def test_the_curves_say_how_far_off_the_whole_is_and_how(
    captions: list[str], data: xr.Dataset, finished: Finished
) -> None:
    found = [caption for caption in captions if "2D − 3D below" in caption]
    assert len(found) > len(synthetic.VARIANTS)
    kinds = set()
    for caption in found:
        variant = caption.split()[1].rstrip(":")
        whole = caption.partition("RMS error over all cells and states: ")[2]
        stated = re.findall(r"(?:^|, | and )([a-z][a-z –-]*?) ([\d.]+) %", whole)
        assert stated
        for label, text in stated:
            (row,) = (
                row
                for row in finished[1]
                if (row["variant"], row["quantity"], row["statistic"], row["status"])
                == (variant, LABELS[label].name, "rms_error", "")
            )
            assert float(text) == pytest.approx(100 * row["error"], abs=5.1e-3)
        for claim in re.finditer(
            CLAIM.pattern + r", there mostly (?P<kind>a constant offset|a change over "
            r"the cycle) of (?P<mean>[+−]?[\d.]+) ± (?P<spread>[\d.]+)",
            caption,
        ):
            field = LABELS[next(label for label in LABELS if claim["label"].strip().endswith(label))]
            at = {"x": int(claim["i"]) - 1, **({"phi": int(claim["j"]) - 1} if claim["j"] else {})}
            local = data.sel(variant=variant).isel(at)
            difference = DIFFERENCE_UNITS[field.unit][1] * (
                local[f"rom_{field.name}"] - local[f"reference_{field.name}"]
            )
            mean, spread = float(difference.mean()), float(difference.std())
            assert _number(claim["mean"]) == pytest.approx(mean, rel=6e-3)
            assert float(claim["spread"]) == pytest.approx(spread, rel=6e-2)
            assert (claim["kind"] == "a constant offset") == (abs(mean) > 2 * spread)
            kinds.add(claim["kind"])
    assert kinds == {"a constant offset"}


@pytest.mark.parametrize(
    ("difference", "said"),
    [
        ([4.0, 5.0, 6.0], "a constant offset of +5.00 ± 0.82 Pa"),
        ([-4.0, 0.0, 5.0], "a change over the cycle of +0.333 ± 3.7 Pa"),
        ([4.0, np.nan, 6.0], ""),
    ],
)
def test_a_difference_is_an_offset_or_a_change(difference: list[float], said: str) -> None:
    words = cycle._kind(np.array(difference), "Pa", 1.0).replace("\u00a0", " ")
    assert words == (f", there mostly {said}" if said else "")


def test_the_maps_say_how_large_differences_are_in_and_beside_the_calcification(
    captions: list[str], data: xr.Dataset
) -> None:
    state = int(np.abs(data["time"].values - data.attrs["compare_times_s"][0]).argmin())
    checked = 0
    for caption in captions:
        words = caption.partition("Mean size of the difference in calcified cells and elsewhere: ")[2]
        if not words:
            continue
        now = data.sel(variant=caption.split()[1].rstrip(",")).isel(time=state)
        inside = now["calcified"].values > 0
        for label, within, beside in re.findall(
            r"([a-z][a-z –-]*?) ([\d.]+)[^;.\d]*? and ([\d.]+)", words.partition(" Framed")[0]
        ):
            field = LABELS[label.strip()]
            sizes = DIFFERENCE_UNITS[field.unit][1] * np.abs(
                now[f"rom_{field.name}"].values - now[f"reference_{field.name}"].values
            )
            assert float(within) == pytest.approx(sizes[inside].mean(), rel=6e-2)
            assert float(beside) == pytest.approx(sizes[~inside].mean(), rel=6e-2)
            checked += 1
    assert checked == 2 * 4


def test_figures_and_tables_are_numbered_and_listed_in_the_contents(
    finished: Finished, pdf_text: Callable[[Path], str]
) -> None:
    text = pdf_text(finished[0] / "report.pdf")
    assert text.index("Contents") < text.index("bands hold")
    for kind in ("Figure", "Table"):
        numbers = [int(n) for n in re.findall(rf"{kind} (\d+)\. ", text)]
        assert numbers == list(range(1, len(numbers) + 1))
        assert len(numbers) > 10


def test_no_page_is_half_empty(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """But the last: a page ends where the next thing, a whole figure or table, did not fit."""
    synthetic.write(tmp_path, synthetic.Setup())
    content = report(load(tmp_path))
    drawings = draw({figure.key: figure.drawing for figure in content.figures()}, None)
    pages: list[bytes] = []
    compile_pdf = typst.compile

    def also_as_pictures(source: Path, **options: Any) -> bytes:
        kept = {name: options[name] for name in ("root", "font_paths", "ignore_system_fonts")}
        pages.extend(compile_pdf(source, format="png", ppi=30.0, **kept))  # type: ignore[arg-type]
        made = compile_pdf(source, **options)
        assert isinstance(made, bytes)
        return made

    monkeypatch.setattr(typst, "compile", also_as_pictures)
    render_pdf(content, drawings)
    from PIL import Image

    filled = []
    for page in pages[:-1]:
        picture = np.asarray(Image.open(io.BytesIO(page)).convert("L"))
        height = picture.shape[0]
        body = picture[: int(0.925 * height)]  # above the footer
        filled.append(np.flatnonzero((body < 200).any(axis=1)).max() / body.shape[0])
    assert len(pages) > 10
    assert [n for n, share in enumerate(filled, start=1) if share < 0.6] == [], json.dumps(filled)

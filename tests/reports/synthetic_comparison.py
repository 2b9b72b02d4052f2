"""A comparison directory made of formulas.

Plausible fields of an artery without, with a ring of and with a patch of calcification, and the metrics,
bands and provenance that belong to them.
"""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

PERIOD = 0.797333
LENGTH = 15e-3
VARIANTS = ("none", "axisymmetric", "local")
TITLES = {
    "none": "No calcification",
    "axisymmetric": "Ring of calcification",
    "local": "Patch of calcification",
}
UNITS = {
    "pressure": "Pa",
    "radius": "m",
    "mean_velocity": "m s-1",
    "profile_exponent": "1",
    "sector_flow_rate": "m3 s-1",
}
EXPONENTS = np.geomspace(0.5, 50.0, 121)
COST = {
    "log": "none.log",
    "febio_version": "4.11.0",
    "ended": "normally",
    "wall_time_s": 949.057,
    "simulated_s": 1.794,
    "time_steps": 450,
    "retries": 2,
    "iterations": 2211,
    "equations": 37572,
}
RUN = {
    "scheme": "semi_implicit",
    "time_step_s": 0.001,
    "steps": 2391,
    "cycles": 3,
    "wall_law": "thick",
    "cycle_change": 8.8e-11,
}
CASE_YAML = "name: synthetic\ngeometry: {length: 15 mm, radius: 2.5 mm}\nwall: {youngs_modulus: 0.6 MPa}\n"


@dataclass
class Setup:
    """Size and words of a synthetic comparison."""

    n_x: int = 12
    n_phi: int = 8
    n_time: int = 11
    n_y: int = 9
    i: tuple[int, ...] = (1, 4, 6, 9, 12)
    j: tuple[int, ...] = (1, 3, 4)
    variants: tuple[str, ...] = VARIANTS
    baseline: str = "none"
    title: str = "Synthetic artery, three patterns of calcification"
    time_names: tuple[str, ...] = ("systole", "second trough", "end diastole")
    notes: tuple[str, ...] = (
        "The viscosity of both models is 0.0035 Pa s.",
        "The stiffness β jumps at φ = 135°.",
    )
    warnings: tuple[str, ...] = ()
    budget: bool = False
    costs: bool = False
    bands: list[dict[str, Any]] = field(
        default_factory=lambda: [
            {
                "quantity": "section_flow_rate",
                "statistic": "rms_error",
                "limit": 0.02,
                "reason": "the inlet polygon has 1.1 % less area",
                "variants": list(VARIANTS),
            },
            {
                "quantity": "radius",
                "statistic": "rms_error",
                "limit": 0.01,
                "reason": "1D against 3D reaches 0.9 %",
                "variants": list(VARIANTS),
            },
            {
                "quantity": "largest_pressure_difference",
                "statistic": "cycle",
                "limit": 0.05,
                "reason": "a local wall is no ring",
                "variants": ["local"],
            },
            {
                "quantity": "mean_velocity",
                "statistic": "max_error",
                "limit": 0.3,
                "reason": "profiles are no power laws",
                "variants": list(VARIANTS),
            },
            {
                "quantity": "phase_lag",
                "statistic": "cycle",
                "limit": 0.02,
                "reason": "the wave takes 3 ms",
                "variants": ["local"],
            },
        ]
    )


def fields(setup: Setup) -> dict[str, np.ndarray]:
    """SI arrays by name, models as the first part of the name."""
    time = np.linspace(0, PERIOD, setup.n_time)
    x = (np.arange(setup.n_x) + 0.5) * LENGTH / setup.n_x
    phi = (np.arange(setup.n_phi) + 0.5) * 2 * np.pi / setup.n_phi
    y = np.linspace(0, 1, setup.n_y)
    t_, x_, p_ = np.meshgrid(time, x, phi, indexing="ij")
    wave = 0.25 + np.exp(-(((t_ - 0.1) / 0.07) ** 2)) + 0.25 * np.exp(-(((t_ - 0.35) / 0.08) ** 2))
    ring = 0.5 * (np.tanh((x_ - 5e-3) / 8e-4) - np.tanh((x_ - 10e-3) / 8e-4))
    patch = {"none": 0 * ring, "axisymmetric": ring, "local": ring * np.exp(-(((p_ - np.pi) / 0.7) ** 4))}
    out: dict[str, list[np.ndarray]] = {}
    for name in setup.variants:
        for model in ("reference", "rom"):
            two = model == "rom"
            soft = patch.get(name, patch["local"])
            stiff = soft if two else 0.75 * soft + 0.25 * soft.mean(axis=2, keepdims=True)
            pressure = (
                12e3
                - 1.0e3 * two
                + (3.2e3 + 600 * two) * wave
                - 40.0 * x_ / LENGTH * (1 + 0.4 * soft)
                + (90.0 if two else 12.0) * soft
            )
            radius = 2.5e-3 + 2.0e-8 * pressure * (1 - 0.9 * stiff)
            flow = (
                (1.5e-6 + 2.9e-6 * wave)
                * (0.955 if two else 1.0)
                * (1 + 0.01 * x_ / LENGTH * np.sin(9 * t_))
                * (1 - 0.01 * soft.mean(axis=2, keepdims=True))
            )
            sector = (
                flow
                / setup.n_phi
                * (1 - (0.0 if two else 0.08) * (stiff - stiff.mean(axis=2, keepdims=True)))
            )
            section = sector.sum(axis=2)
            speed = sector * setup.n_phi / (np.pi * radius**2)
            gamma = (2.0 + (0.1 if two else 0.6) * np.sin(6 * t_) + stiff) + (
                0.0 if two else 0.8 * x_ / LENGTH
            )
            profile = speed[..., None] * (1 + 2 / gamma[..., None]) * (1 - y ** gamma[..., None])
            for key, values in (
                ("pressure", pressure),
                ("radius", radius),
                ("mean_velocity", speed),
                ("profile_exponent", gamma),
                ("sector_flow_rate", sector),
                ("section_flow_rate", section),
                ("section_pressure", pressure.mean(axis=2)),
                ("axial_velocity", profile.astype(np.float32)),
                ("mass_defect", (1e-12 if two else 0.004) * np.sin(9 * time)),
                ("axis_velocity_spread", 0.0 * section),
            ):
                out.setdefault(f"{model}_{key}", []).append(values)
            if two:
                out.setdefault("rom_axial_dominance_radial", []).append(0.01 + 0.1 * stiff[0])
            else:
                across = np.zeros_like(profile)
                across[..., 1:-1] = 0.02 * np.gradient(radius, x, axis=1)[..., None] * profile[..., 1:-1]
                for key, values in (
                    ("radial_velocity", across.astype(np.float32)),
                    ("azimuthal_velocity", (0.1 * across).astype(np.float32)),
                    ("profile_error", 0.01 + 0.02 * stiff),
                    ("backflow_fraction", 0.0 * time),
                    ("axial_dominance_radial", 0.01 + 0.2 * stiff[0]),
                    ("axial_dominance_azimuthal", 0.001 + 0.05 * stiff[0]),
                ):
                    out.setdefault(f"reference_{key}", []).append(values)
        wall = patch.get(name, patch["local"])[0]
        out.setdefault("rom_wall_stiffness", []).append(130.0 * (1 + 15 * wall))
        out.setdefault("calcified", []).append((wall > 0.5).astype(np.int8))
    return {key: np.stack(value) for key, value in out.items()} | {"time": time, "x": x, "phi": phi, "y": y}


def dataset(setup: Setup, arrays: dict[str, np.ndarray]) -> xr.Dataset:
    """The arrays as comparison.nc holds them."""
    rays = ("variant", "time", "x", "phi", "y")
    walls = (
        "rom_wall_stiffness",
        "rom_axial_dominance_radial",
        "calcified",
        *(f"reference_axial_dominance_{a}" for a in ("radial", "azimuthal")),
    )
    variables = {
        key: (("variant", "x", "phi") if key in walls else rays[: values.ndim], values)
        for key, values in arrays.items()
        if key not in rays
    }
    times = [float(arrays["time"][k]) for k in states(setup, arrays)]
    columns, rows = np.array(setup.i) - 1, np.array(setup.j) - 1
    shown = ("variant", "compare_time", "compare_x", "compare_phi", "exponent")
    variables["reference_profile_error_curve"] = (shown, fit_errors(setup, arrays, EXPONENTS))
    return xr.Dataset(
        variables,
        coords={
            "variant": list(setup.variants),
            **{k: arrays[k] for k in ("time", "x", "phi", "y")},
            "compare_time": times,
            "compare_x": arrays["x"][columns],
            "compare_phi": arrays["phi"][rows],
            "exponent": EXPONENTS,
        },
        attrs={
            "case": "synthetic",
            "title": setup.title,
            "models": json.dumps(["rom"]),
            "variant_titles": json.dumps([TITLES.get(name, name) for name in setup.variants]),
            "baseline": setup.baseline,
            "period_s": PERIOD,
            "compare_i": np.array(setup.i),
            "compare_j": np.array(setup.j),
            "compare_time_names": json.dumps(setup.time_names),
            "compare_times_s": np.array(times),
            "case_yaml": CASE_YAML,
            "Conventions": "CF-1.11",
        },
    )


def fit_errors(setup: Setup, arrays: dict[str, np.ndarray], exponents: np.ndarray) -> np.ndarray:
    """Relative error of the closest profile with each exponent at the shown cells and named instants."""
    at = np.ix_(
        range(len(setup.variants)), states(setup, arrays), np.array(setup.i) - 1, np.array(setup.j) - 1
    )
    v = arrays["reference_axial_velocity"][at].astype(float)
    s = 1 - arrays["y"] ** exponents[:, None]
    rest = 1 - (v @ s.T) ** 2 / (np.sum(s**2, axis=-1) * np.sum(v**2, axis=-1, keepdims=True))
    return np.sqrt(np.clip(rest, 0.0, None))


def _profile_error_rows(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    """The error of the closest profile, and with the 2D model's own exponent, at the shown cells."""
    rows = []
    for v, variant in enumerate(setup.variants):
        for k, state in enumerate(states(setup, arrays)):
            for a, i in enumerate(setup.i):
                for b, j in enumerate(setup.j):
                    own = arrays["rom_profile_exponent"][v][state, i - 1, j - 1]
                    best = fit_errors(setup, arrays, EXPONENTS)[v, k, a, b].min()
                    rows.append(
                        _row(
                            variant,
                            "profile_error",
                            "value",
                            "1",
                            i=i,
                            j=j,
                            t_s=float(arrays["time"][state]),
                            reference=float(best),
                            rom=float(fit_errors(setup, arrays, np.array([own]))[v, k, a, b, 0]),
                        )
                    )
    return rows


def states(setup: Setup, arrays: dict[str, np.ndarray]) -> list[int]:
    """The states nearest to the instants of the thesis, as many as are named."""
    return [int(np.abs(arrays["time"] - t).argmin()) for t in (0.1, 0.28, PERIOD)][: len(setup.time_names)]


def _row(variant: str, quantity: str, statistic: str, unit: str, **rest: Any) -> dict[str, Any]:
    blank = dict.fromkeys(("i", "j", "t_s", "rom", "reference", "error", "band"))
    return {
        "case": "synthetic",
        "variant": variant,
        "model": "rom",
        "quantity": quantity,
        "statistic": statistic,
        "inflow": "",
        **blank,
        "unit": unit,
        "status": "",
        **rest,
    }


def _cell_rows(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    rows = []
    base = setup.variants.index(setup.baseline) if setup.baseline else None
    for v, variant in enumerate(setup.variants):
        for quantity, unit in (*UNITS.items(), ("section_flow_rate", "m3 s-1")):
            two, three = arrays[f"rom_{quantity}"], arrays[f"reference_{quantity}"]
            for state in states(setup, arrays):
                for i in setup.i:
                    for j in (None,) if quantity == "section_flow_rate" else setup.j:
                        at = (state, i - 1) if j is None else (state, i - 1, j - 1)
                        b, a = float(two[v][at]), float(three[v][at])
                        where = {"i": i, "j": j, "t_s": float(arrays["time"][state])}
                        rows.append(
                            _row(
                                variant,
                                quantity,
                                "value",
                                unit,
                                **where,
                                rom=b,
                                reference=a,
                                error=b / a - 1,
                            )
                        )
                        if base is not None and v != base:
                            b0, a0 = float(two[base][at]), float(three[base][at])
                            rows.append(
                                _row(
                                    variant,
                                    quantity,
                                    "change",
                                    unit,
                                    **where,
                                    rom=b - b0,
                                    reference=a - a0,
                                )
                            )
                            rows.append(
                                _row(
                                    variant,
                                    quantity,
                                    "ratio",
                                    "1",
                                    **where,
                                    rom=b / b0,
                                    reference=a / a0,
                                )
                            )
    return rows


def _pooled_rows(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    rows = []
    for v, variant in enumerate(setup.variants):
        for quantity, unit in (*UNITS.items(), ("section_flow_rate", "m3 s-1")):
            two, three = arrays[f"rom_{quantity}"][v], arrays[f"reference_{quantity}"][v]
            error = two / three - 1
            at = np.unravel_index(int(np.abs(error).argmax()), error.shape)
            found = {
                "t_s": float(arrays["time"][at[0]]),
                "i": int(at[1]) + 1,
                "j": int(at[2]) + 1 if len(at) == 3 else None,
            }
            for statistic, value in (
                ("bias", error.mean()),
                ("scatter", error.std()),
                ("rms_error", np.sqrt((error**2).mean())),
            ):
                rows.append(_row(variant, quantity, statistic, unit, error=float(value)))
            rows.append(_row(variant, quantity, "max_error", unit, error=float(error[at]), **found))
            if setup.baseline and variant != setup.baseline:
                rows.append(_change_row(setup, arrays, variant, quantity, unit))
    return rows


def _change_row(
    setup: Setup, arrays: dict[str, np.ndarray], variant: str, quantity: str, unit: str
) -> dict[str, Any]:
    """How far both models' changes from the baseline are apart over all cells and states."""
    now, base = setup.variants.index(variant), setup.variants.index(setup.baseline)

    def change(model: str) -> np.ndarray:
        values = arrays[f"{model}_{quantity}"]
        return np.asarray(values[now] - values[base])

    two, three = change("rom"), change("reference")
    sizes = {"rom": _rms(two), "reference": _rms(three), "error": _rms(two - three) / _rms(three)}
    return _row(variant, quantity, "change_rms", unit, **sizes)


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt((values**2).mean()))


def _cycle_rows(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    def numbers(model: str, v: int) -> dict[str, tuple[float, str]]:
        p, r = arrays[f"{model}_section_pressure"][v], arrays[f"{model}_radius"][v]
        return {
            "systolic_pressure": (p.max(), "Pa"),
            "diastolic_pressure": (p.min(), "Pa"),
            "pulse_pressure": (np.ptp(p), "Pa"),
            "largest_radius": (r.max(), "m"),
            "least_radius": (r.min(), "m"),
            "largest_pressure_difference": (np.ptp(p, axis=1).max(), "Pa"),
            "largest_radius_variation": (np.ptp(r, axis=(1, 2)).max(), "m"),
        }

    rows = []
    for v, variant in enumerate(setup.variants):
        two, three = numbers("rom", v), numbers("reference", v)
        for quantity, (b, unit) in two.items():
            a = three[quantity][0]
            rows.append(
                _row(
                    variant,
                    quantity,
                    "cycle",
                    unit,
                    rom=float(b),
                    reference=float(a),
                    error=float(b / a - 1),
                )
            )
            if setup.baseline and variant != setup.baseline:
                base = setup.variants.index(setup.baseline)
                b0, a0 = numbers("rom", base)[quantity][0], numbers("reference", base)[quantity][0]
                rows.append(
                    _row(variant, quantity, "change", unit, rom=float(b - b0), reference=float(a - a0))
                )
                rows.append(_row(variant, quantity, "ratio", "1", rom=float(b / b0), reference=float(a / a0)))
    return rows


def _check_rows(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    rows = []
    for v, variant in enumerate(setup.variants):
        for quantity in ("mass_defect", "axis_velocity_spread"):
            two, three = (float(np.abs(arrays[f"{m}_{quantity}"][v]).max()) for m in ("rom", "reference"))
            rows.append(_row(variant, quantity, "largest", "1", rom=two, reference=three))
        backflow = float(arrays["reference_backflow_fraction"][v].max())
        rows.append(_row(variant, "backflow_fraction", "largest", "1", reference=backflow))
        for quantity in ("axial_dominance_radial", "axial_dominance_azimuthal"):
            ratio = arrays[f"reference_{quantity}"][v]
            at = np.unravel_index(int(ratio.argmax()), ratio.shape)
            where = {"i": int(at[0]) + 1, "j": int(at[1]) + 1}
            rows.append(_row(variant, quantity, "largest", "1", reference=float(ratio[at]), **where))
            rows += [
                _row(variant, quantity, "value", "1", reference=float(ratio[i - 1, j - 1]), i=i, j=j)
                for i in setup.i
                for j in setup.j
            ]
        for k, t in enumerate(arrays["time"]):
            flow = arrays["reference_section_flow_rate"][v][k]
            unit, t_s = "m3 s-1", float(t)
            rows += [
                _row(
                    variant,
                    "section_flow_rate",
                    "plane_integral",
                    unit,
                    reference=float(flow[i - 1]),
                    error=-0.001,
                    i=i,
                    t_s=t_s,
                )
                for i in setup.i
            ]
            error = 0.0004 * (1 + k)
            rows.append(
                _row(
                    variant,
                    "section_flow_rate",
                    "prescribed_inflow",
                    unit,
                    reference=float(flow[0]),
                    error=error,
                    t_s=t_s,
                )
            )
    return rows


def _budget_rows(pooled: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Budgets of the root mean squares: half of an error is the inflow's, a twentieth the 3D mesh's."""
    parts = {"error": 1.0, "inflow": 0.5, "matched": 0.5, "mesh": 0.05, "uncertainty": 0.05}
    parts |= {"model_low": 0.45, "model_high": 0.55}
    return [
        _row(row["variant"], row["quantity"], f"budget_{part}", "1", error=share * row["error"])
        for row in pooled
        if row["statistic"] == "rms_error"
        for part, share in parts.items()
    ]


def metrics(setup: Setup, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    """Rows as metrics.json holds them, those of the bands last."""
    pooled = _pooled_rows(setup, arrays)
    rows = _cell_rows(setup, arrays) + pooled + (_budget_rows(pooled) if setup.budget else [])
    rows += _cycle_rows(setup, arrays) + _check_rows(setup, arrays) + _profile_error_rows(setup, arrays)
    judged = []
    for band in setup.bands:
        for variant in (name for name in band["variants"] if name in setup.variants):
            found = [
                row
                for row in rows
                if (row["variant"], row["quantity"], row["statistic"])
                == (variant, band["quantity"], band["statistic"])
                and (row["i"] is None or row["statistic"] == "max_error")
            ]
            row = found[0] if found else _row(variant, band["quantity"], band["statistic"], "s")
            status = "MISSING" if not found else "OK" if abs(row["error"]) <= band["limit"] else "FAIL"
            judged.append({**row, "band": band["limit"], "status": status})
    return rows + judged


def provenance(setup: Setup) -> dict[str, Any]:
    """What provenance.json holds."""

    def sha(text: str) -> str:
        return hashlib.sha256(text.encode()).hexdigest()

    run = RUN | {"n_x": setup.n_x, "n_phi": setup.n_phi}
    return {
        "created": "2026-03-04T05:06:07+00:00",
        "command": "python -m validation.compare cases/calcification.yaml --output results/calcification",
        "git_commit": "0123456789abcdef0123456789abcdef01234567",
        "package_version": "0.1.0",
        "python": "3.11.9",
        "versions": {
            "numpy": "2.4.6",
            "scipy": "1.16.0",
            "numba": "0.62.1",
            "xarray": "2026.9.0",
            "typst": "0.15.2",
        },
        "machine": {"system": "Linux 6.1", "processor": "x86_64", "cores": 2},
        "case": {"path": "cases/calcification.yaml", "sha256": sha(CASE_YAML)},
        "inputs": [
            *(
                {"path": f"reference_data/febio/{name}.xplt", "sha256": sha(name), "bytes": 3500000 + k}
                for k, name in enumerate(setup.variants)
            ),
            {"path": "reference_data/waveforms/thesis_inlet.csv", "sha256": sha("waveform"), "bytes": 274},
        ],
        "wall_times_s": {"2D model, none": 0.81, "3D reading, none": 4.2, "mapping onto cells": 11.5},
        "notes": list(setup.notes),
        "warnings": list(setup.warnings),
        "variants": {
            name: {
                "models": {"rom": run | ({"simulation_wall_time_s": 0.5} if setup.costs else {})},
                "reference": {
                    "file": f"reference_data/febio/{name}.xplt",
                    "software": "FEBio",
                    "version": "4.11",
                    "nodes": 8215,
                    "elements": 7920,
                    "states": setup.n_time,
                    "coverage": 1.0,
                }
                | ({"cost": COST} if setup.costs else {}),
            }
            for name in setup.variants
        },
        "bands": [
            {**band, "variants": [name for name in band["variants"] if name in setup.variants]}
            for band in setup.bands
        ],
    }


def of_models(setup: Setup, models: Sequence[str]) -> dict[str, dict[str, np.ndarray]]:
    """Arrays by model: what each after the first gives is a percent above that of the one before."""
    arrays = fields(setup)
    return {
        model: {key: values * 1.01**k if key.startswith("rom_") else values for key, values in arrays.items()}
        for k, model in enumerate(models)
    }


def content(setup: Setup, models: Sequence[str]) -> tuple[xr.Dataset, list[dict[str, Any]], dict[str, Any]]:
    """What comparison.nc, metrics.json and provenance.json hold of one or several models."""
    by_model = of_models(setup, models)
    parts, rows = [], []
    for model, arrays in by_model.items():
        single = dataset(setup, arrays)
        own = {name: f"{model}_{str(name)[4:]}" for name in single.data_vars if str(name).startswith("rom_")}
        parts.append(single.rename(own) if not parts else single[list(own)].rename(own))
        rows += [{**row, "model": model} for row in metrics(setup, arrays)]
    record = provenance(setup)
    for of_variant in record["variants"].values():
        of_variant["models"] = dict.fromkeys(models, of_variant["models"]["rom"])
    merged = xr.merge(parts, combine_attrs="override").assign_attrs(models=json.dumps(list(models)))
    return merged, rows, record


_WRITTEN: dict[str, dict[str, bytes]] = {}  # files of what was written before: many tests want the same


def write(
    directory: Path, setup: Setup | None = None, models: tuple[str, ...] = ("rom",)
) -> list[dict[str, Any]]:
    """Write a finished comparison and return its metrics."""
    directory.mkdir(parents=True, exist_ok=True)
    files = _WRITTEN.setdefault(f"{setup or Setup()} {models}", {})
    if not files:
        both, rows, record = content(setup or Setup(), models)
        both.to_netcdf(directory / "comparison.nc", engine="netcdf4")
        files["comparison.nc"] = (directory / "comparison.nc").read_bytes()
        files |= {"metrics.json": json.dumps(rows).encode(), "provenance.json": json.dumps(record).encode()}
    for name, written in files.items():
        (directory / name).write_bytes(written)
    return list(json.loads(files["metrics.json"]))

"""One table that names every quantity: in case files, NetCDF output, metrics, figures and reports.

A quantity's SI unit is what arrays and files hold; its display unit is what people read. A quantity that
both models have says here how it is compared: names in bands, rows of metrics and words of reports follow.
"""

from dataclasses import dataclass

from cases.statistics import JUDGED, OF_POSITIVE

CELL = ("time", "x", "phi")
SECTION = ("time", "x")
RAY = ("time", "x", "phi", "y")


@dataclass(frozen=True)
class Compared:
    """How a quantity that both models have is compared.

    Attributes
    ----------
    reads : tuple of str
        Fields that it is computed from, by the function of its name in `validation.metrics.quantities`; empty
        for a field of both models itself.
    tabulated : bool
        Whether its values at the chosen cells and instants have rows, with what calcification changes and
        how sure the bias is. A number of the cycle always has.
    pooled : bool
        Whether its errors have rows: over all cells, and over the cycle at the chosen cells.
    statistics : tuple of str
        What is pooled, and what a band may limit.
    """

    reads: tuple[str, ...] = ()
    tabulated: bool = True
    pooled: bool = True
    statistics: tuple[str, ...] = OF_POSITIVE


@dataclass(frozen=True)
class Field:
    """One quantity.

    Attributes
    ----------
    name : str
        Name in files, metrics and case files.
    symbol : str
        Symbol in formulas and on axes.
    label : str
        Words for captions and CF ``long_name``.
    unit, display_unit : str
        SI unit of stored values; unit people read. Both "1" where dimensionless.
    display_factor : float
        Display value = stored value × display_factor.
    dims : tuple of str
        Dimensions of the stored array; empty for one number per cycle.
    compared : Compared or None
        How it is compared; None where bands do not judge it.
    """

    name: str
    symbol: str
    label: str
    unit: str
    display_unit: str
    display_factor: float
    dims: tuple[str, ...]
    compared: Compared | None = None


def _table(*fields: Field) -> dict[str, Field]:
    return {field.name: field for field in fields}


OF_MODELS = Compared()  # fields of both models, in all tables
OF_FLOW = Compared(statistics=tuple(JUDGED))  # what may pass zero
OF_BANDS = Compared(tabulated=False, pooled=False, statistics=tuple(JUDGED))
OF_BOTH = Compared(reads=("axis_velocity",), tabulated=False, pooled=False, statistics=tuple(JUDGED))
OF_PRESSURE, OF_RADIUS = Compared(reads=("section_pressure",)), Compared(reads=("radius",))

FIELDS = _table(
    Field("pressure", "P", "pressure", "Pa", "kPa", 1e-3, CELL, OF_MODELS),
    Field("radius", "R", "lumen radius", "m", "mm", 1e3, CELL, OF_MODELS),
    Field(
        "radius_change",
        "ΔR",
        "lumen radius over its least of the cycle",
        "m",
        "mm",
        1e3,
        SECTION,
        Compared(reads=("radius",), tabulated=False, pooled=False, statistics=tuple(JUDGED)),
    ),
    Field("mean_velocity", "u", "mean velocity along the ray", "m s-1", "cm/s", 1e2, CELL, OF_FLOW),
    Field("sector_flow_rate", "q_φ", "flow rate through one sector", "m3 s-1", "cm³/s", 1e6, CELL, OF_FLOW),
    Field("profile_exponent", "γ", "velocity-profile exponent", "1", "1", 1.0, CELL, OF_MODELS),
    Field("axis_velocity", "D", "velocity on the axis", "m s-1", "cm/s", 1e2, SECTION, OF_BOTH),
    Field("profile_bend", "B", "second mode of the velocity profile", "m s-1", "cm/s", 1e2, CELL),
    Field(
        "sector_flow_share",
        "q_φ/q̄_φ",
        "sector's flow rate over the section's mean",
        "1",
        "1",
        1.0,
        CELL,
        Compared(reads=("sector_flow_rate", "section_flow_rate"), tabulated=False),
    ),
    Field("azimuthal_flux", "W", "azimuthal flux 2∫v_φ dr", "m2 s-1", "cm²/s", 1e4, CELL),
    Field(
        "section_flow_rate", "q", "flow rate through the section", "m3 s-1", "cm³/s", 1e6, SECTION, OF_FLOW
    ),
    Field("section_pressure", "P̄", "mean pressure over the section", "Pa", "kPa", 1e-3, SECTION, OF_MODELS),
    Field(
        "section_pressure_range",
        "ΔP_section",
        "largest difference of pressure between any two points of the section",
        "Pa",
        "Pa",
        1.0,
        SECTION,
    ),
    Field("axial_velocity", "v_x", "axial velocity", "m s-1", "cm/s", 1e2, RAY, OF_BANDS),
    Field("radial_velocity", "v_r", "radial velocity", "m s-1", "cm/s", 1e2, RAY),
    Field("azimuthal_velocity", "v_φ", "azimuthal velocity", "m s-1", "cm/s", 1e2, RAY),
    Field("two_mode_error", "ε_DB", "relative error of the closest two modes", "1", "%", 1e2, CELL),
    Field("profile_error", "ε_γ", "relative error of the closest profile", "1", "%", 1e2, CELL),
    Field("wall_stiffness", "β", "wall stiffness", "Pa m", "N/m", 1.0, ("x", "phi")),
    Field("systolic_pressure", "P_sys", "systolic pressure", "Pa", "kPa", 1e-3, (), OF_PRESSURE),
    Field("diastolic_pressure", "P_dia", "diastolic pressure", "Pa", "kPa", 1e-3, (), OF_PRESSURE),
    Field("pulse_pressure", "P_sys − P_dia", "pulse pressure", "Pa", "kPa", 1e-3, (), OF_PRESSURE),
    Field("largest_radius", "R_max", "largest lumen radius", "m", "mm", 1e3, (), OF_RADIUS),
    Field("least_radius", "R_min", "least lumen radius", "m", "mm", 1e3, (), OF_RADIUS),
    Field(
        "largest_pressure_difference",
        "max ΔP",
        "largest difference of section pressure along the artery at one instant",
        "Pa",
        "Pa",
        1.0,
        (),
        OF_PRESSURE,
    ),
    Field(
        "largest_radius_variation",
        "max ΔR",
        "largest difference of radius over the artery at one instant",
        "m",
        "μm",
        1e6,
        (),
        OF_RADIUS,
    ),
    Field(
        "phase_lag", "Δt", "lag of the reduced model's outlet flow behind the reference's", "s", "ms", 1e3, ()
    ),
    Field("wall_time", "t_wall", "wall time of the simulation", "s", "s", 1.0, ()),
    Field("time_steps", "n_t", "time steps of the simulation", "1", "1", 1.0, ()),
    Field("iterations", "n_it", "equilibrium iterations of the simulation", "1", "1", 1.0, ()),
    Field("mass_defect", "δ_m", "inflow − outflow − dV/dt, over the inflow", "1", "%", 1e2, ("time",)),
    Field("courant_number", "Co", "largest wave speed × Δt/Δx", "1", "1", 1.0, ("time",)),
    Field("advective_courant_number", "Co_u", "largest mean velocity × Δt/Δx", "1", "1", 1.0, ("time",)),
    Field(
        "continuity_residual",
        "δ_D",
        "largest relative distance of the axis velocity from its section's mean",
        "1",
        "1",
        1.0,
        ("time",),
    ),
    Field("kinetic_energy", "E_k", "kinetic energy of the mean flow", "J", "μJ", 1e6, ("time",)),
    Field("wall_energy", "E_w", "energy stored by the wall", "J", "μJ", 1e6, ("time",)),
    Field("end_power", "W_e", "power of the inlet less that of the outlet", "W", "mW", 1e3, ("time",)),
    Field("dissipated_power", "W_v", "power lost to viscosity", "W", "mW", 1e3, ("time",)),
    Field("profile_power", "W_α", "power that the profile's shape takes", "W", "mW", 1e3, ("time",)),
    Field(
        "energy_defect",
        "δ_E",
        "power that the balance of mechanical energy misses, over the largest exchange so far",
        "1",
        "%",
        1e2,
        ("time",),
    ),
    Field(
        "axial_dominance_radial",
        "|v_r|/v_x",
        "largest |v_r|/v_x over the ray and the cycle",
        "1",
        "1",
        1.0,
        ("x", "phi"),
    ),
    Field(
        "axial_dominance_azimuthal",
        "|v_φ|/v_x",
        "largest |v_φ|/v_x over the ray and the cycle",
        "1",
        "1",
        1.0,
        ("x", "phi"),
    ),
    Field(
        "backflow_fraction",
        "backflow",
        "share of ray points with v_x ≤ 0 away from the wall",
        "1",
        "%",
        1e2,
        ("time",),
    ),
    Field(
        "axis_velocity_spread",
        "δ_axis",
        "spread over φ of v_x on the axis, over its mean",
        "1",
        "%",
        1e2,
        SECTION,
    ),
)

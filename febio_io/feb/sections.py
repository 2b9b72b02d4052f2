"""The small sections of a model as XML: all but the mesh."""

from xml.etree.ElementTree import Element, SubElement

from febio_io.feb.model import (
    ArteryModel,
    Curve,
    MeshSize,
    Outlet,
    PrescribedPressure,
    Resistance,
    Timing,
    Wall,
    Windkessel,
)

BLOOD, HEALTHY, CALCIFIED = "Blood", "Healthy", "Calcified"
CORE, LUMEN, WALL_HEALTHY, WALL_CALCIFIED = "LumenCore", "Lumen", "WallHealthy", "WallCalcified"
INLET, OUTLET, INTERFACE = "Inlet", "Outlet", "Interface"
ALL_NODES, BLOOD_NODES, INTERFACE_NODES = "All_nodes", "Lumen_nodes", "Interface_nodes"
INLET_NODES, AXIS_NODES = "Inlet_nodes", "Center_nodes"
# Wall nodes in the planes across and along φ = 0, which in the model's own axes are those of x = 0 and y = 0.
ACROSS_NODES, ALONG_NODES = "Wall_x0", "Wall_y0"
INFLOW_CURVE, RAMP_CURVE, PRESSURE_CURVE, DISTAL_CURVE = 1, 2, 3, 4
# What the comparison needs; the flow rate once a surface, as FEBio keeps one set of areas a variable.
PLOTTED = ("displacement", "nodal fluid velocity", "fluid pressure")
STEPS_DOWN = 64  # how often a failing time step may be halved, as a factor
BLOOD_SOLID_MODULUS = "1e-9"  # of the mesh that carries the blood: no stiffness to speak of, Pa
SOLVER = {
    "symmetric_stiffness": "non-symmetric",
    "equation_scheme": "staggered",
    "lstol": "0.9",
    "lsmin": "0.01",
    "lsiter": "5",
    "max_refs": "5",
    "reform_each_time_step": "0",
    "diverge_reform": "0",
    "dtol": "0.001",
    "vtol": "0.001",
    "ftol": "0.001",
    "etol": "0.01",
    "rtol": "0.001",
    "rhoi": "0",
    "predictor": "0",
    "min_volume_ratio": "0",
    "order": "2",
}
BROYDEN = {"max_ups": "50", "max_buffer_size": "0", "cycle_buffer": "1", "cmax": "100000"}


def number(value: float) -> str:
    """Write a number so that it is read back exactly."""
    return repr(float(value))


def _leaves(parent: Element, values: dict[str, str]) -> None:
    for name, text in values.items():
        SubElement(parent, name).text = text


def _ramped(parent: Element, name: str, value: float) -> None:
    SubElement(parent, name, lc=str(RAMP_CURVE)).text = number(value)


def module() -> Element:
    """Say which equations are solved."""
    return Element("Module", type="fluid-FSI")


def control(timing: Timing) -> Element:
    """Time stepping and the solver."""
    section = Element("Control")
    _leaves(
        section,
        {
            "analysis": "DYNAMIC",
            "time_steps": str(timing.n_steps),
            "step_size": number(timing.time_step),
            "plot_zero_state": "1",
            "plot_stride": str(timing.stride),
        },
    )
    _leaves(
        SubElement(section, "time_stepper", type="default"),
        {
            "max_retries": "8",
            "opt_iter": "50",
            "dtmin": number(timing.time_step / STEPS_DOWN),
            "dtmax": number(timing.time_step),
            "aggressiveness": "0",
            "cutback": "0.5",
        },
    )
    solver = SubElement(section, "solver", type="fluid-FSI")
    _leaves(solver, SOLVER)
    _leaves(SubElement(solver, "qn_method", type="Broyden"), BROYDEN)
    return section


def global_constants() -> Element:
    """Constants that every model states; this one uses none."""
    section = Element("Globals")
    _leaves(SubElement(section, "Constants"), {"T": "0", "R": "0", "Fc": "0"})
    return section


def materials(model: ArteryModel) -> Element:
    """Blood, the healthy wall, and the calcified one if there is any."""
    section = Element("Material")
    blood = SubElement(section, "material", id="1", name=BLOOD, type="fluid-FSI")
    solid = {"density": "0", "E": BLOOD_SOLID_MODULUS, "v": "0"}
    _leaves(SubElement(blood, "solid", type="neo-Hookean"), solid)
    fluid = SubElement(blood, "fluid", type="fluid")
    _leaves(fluid, {"density": number(model.blood.density), "k": number(model.blood.bulk_modulus)})
    viscous = SubElement(fluid, "viscous", type="Newtonian fluid")
    _leaves(viscous, {"kappa": "0", "mu": number(model.blood.viscosity)})
    _wall(section, "2", HEALTHY, model.wall, model.wall.youngs_modulus)
    if model.patch is not None:
        _wall(section, "3", CALCIFIED, model.wall, model.patch.youngs_modulus)
    return section


def _wall(section: Element, number_: str, name: str, wall: Wall, modulus: float) -> None:
    material = SubElement(section, "material", id=number_, name=name, type=wall.law)
    values = {"density": wall.density, "E": modulus, "v": wall.poisson_ratio}
    _leaves(material, {key: number(value) for key, value in values.items()})


def mesh_domains(with_calcified: bool, with_healthy: bool) -> Element:
    """Say which domain is of which material."""
    section = Element("MeshDomains")
    pairs = [(CORE, BLOOD), (LUMEN, BLOOD)]
    pairs += [(WALL_HEALTHY, HEALTHY)] if with_healthy else []
    pairs += [(WALL_CALCIFIED, CALCIFIED)] if with_calcified else []
    for name, material in pairs:
        SubElement(section, "SolidDomain", name=name, mat=material)
    return section


def boundary(model: ArteryModel) -> Element:
    """Supports, no slip, and the outlet."""
    section = Element("Boundary")
    first, second, along = (_letter(direction) for direction in _directions(model))
    _fixed(section, "fix_axial", ALL_NODES, along)
    _fixed(section, "fix_center", AXIS_NODES, first + second)
    # Nodes at φ = ±π/2 have nothing towards φ = 0, and those at φ = 0 and π nothing across it.
    _fixed(section, "radial_across", ACROSS_NODES, first)
    _fixed(section, "radial_along", ALONG_NODES, second)
    slip = SubElement(section, "bc", name="noslip", node_set=INTERFACE_NODES, type="zero fluid velocity")
    _leaves(slip, {f"w{axis}_dof": "1" for axis in "xyz"})
    _outlet(section, model.outlet)
    return section


def _directions(model: ArteryModel) -> list[list[float]]:
    rows: list[list[float]] = model.frame.rotation().tolist()
    return rows


def _letter(direction: list[float]) -> str:
    return next(letter for letter, part in zip("xyz", direction, strict=True) if part)


def _fixed(section: Element, name: str, node_set: str, axes: str) -> None:
    condition = SubElement(section, "bc", name=name, node_set=node_set, type="zero displacement")
    _leaves(condition, {f"{axis}_dof": str(int(axis in axes)) for axis in "xyz"})


def _outlet(section: Element, outlet: Outlet) -> None:
    match outlet:
        case Resistance():
            condition = SubElement(section, "bc", name="outlet", surface=OUTLET, type="fluid resistance")
            _ramped(condition, "R", outlet.resistance)
            _ramped(condition, "pressure_offset", outlet.offset)
        case Windkessel():
            condition = SubElement(section, "bc", name="outlet", surface=OUTLET, type="fluid RCR")
            _ramped(condition, "R", outlet.proximal_resistance)
            SubElement(condition, "Rd", lc=str(DISTAL_CURVE)).text = number(outlet.distal_resistance)
            _leaves(condition, {"capacitance": number(outlet.compliance)})
            SubElement(condition, "pressure_offset", lc=str(PRESSURE_CURVE)).text = "1"
            _leaves(condition, {"initial_pressure": "0"})
        case PrescribedPressure():
            condition = SubElement(section, "bc", name="outlet", surface=OUTLET, type="fluid pressure")
            SubElement(condition, "pressure", lc=str(PRESSURE_CURVE)).text = "1"


def loads() -> Element:
    """Inflow, stabilization of the outlet, and the traction of the blood on the wall."""
    section = Element("Loads")
    inflow = SubElement(section, "surface_load", name="inlet", surface=INLET, type="fluid normal velocity")
    # Along the outward normal, hence negative; without its rim's pressure the inlet's ring collapses.
    SubElement(inflow, "velocity", lc=str(INFLOW_CURVE)).text = "-1"
    for name in ("prescribe_nodal_velocities", "parabolic", "prescribe_rim_pressure"):
        SubElement(inflow, name).text = "1"
    for name in ("backflow", "tangential"):
        kind = f"fluid {name} stabilization"
        load = SubElement(section, "surface_load", name=name, surface=OUTLET, type=kind)
        SubElement(load, "beta").text = "1"
    SubElement(section, "surface_load", name="fsi", surface=INTERFACE, type="fluid-FSI traction")
    return section


def load_data(model: ArteryModel) -> Element:
    """Load curves."""
    section = Element("LoadData")
    _curve(section, INFLOW_CURVE, "inflow", model.inflow)
    _curve(section, RAMP_CURVE, "ramp", model.ramp)
    match model.outlet:
        case PrescribedPressure(pressure):
            _curve(section, PRESSURE_CURVE, "outlet pressure", pressure)
        case Windkessel(distal_share=share, offset=offset):
            _curve(section, PRESSURE_CURVE, "pressure offset", offset)
            _curve(section, DISTAL_CURVE, "distal resistance", share)
    return section


def _curve(section: Element, curve_id: int, name: str, curve: Curve) -> None:
    controller = SubElement(section, "load_controller", id=str(curve_id), name=name, type="loadcurve")
    _leaves(controller, {"interpolate": "LINEAR", "extend": "CONSTANT"})
    points = SubElement(controller, "points")
    for time, value in zip(curve.times.tolist(), curve.values.tolist(), strict=True):
        SubElement(points, "pt").text = f"{time:.9g},{value:.9e}"


def output(model: ArteryModel, axis_nodes: list[int]) -> Element:
    """Plot file and, if asked for, data records of the axis and of the innermost elements at mid-length."""
    section = Element("Output")
    plot = SubElement(section, "plotfile", type="febio")
    for name in PLOTTED:
        SubElement(plot, "var", type=name)
    for surface in (INLET, OUTLET):
        SubElement(plot, "var", type="fluid flow rate", surface=surface)
    SubElement(plot, "compression").text = "1"
    if model.records is not None:
        log = SubElement(section, "logfile")
        nodes = SubElement(
            log, "node_data", data="x;y;z;nfvx;nfvy;nfvz", file=f"{model.records}_axis_nodes.txt", delim=","
        )
        nodes.text = ",".join(map(str, axis_nodes))
        elements = SubElement(
            log,
            "element_data",
            data=f"x;y;z;fp;fv{model.frame.axis}",
            name="mid-plane fluid",
            file=f"{model.records}_mid_elements.txt",
        )
        elements.text = _middle_elements(model.size)
    return section


def _middle_elements(size: MeshSize) -> str:
    first = size.n_z // 2 * size.core_elements + 1
    return f"{first}:{first + size.core_elements - 1}"

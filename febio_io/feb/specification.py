"""What FEBio 4 (``febio_spec version="4.0"``) allows in a fluid-FSI model, as far as arteries need it.

From FEBio's user manual and feature manual; one table, which :mod:`febio_io.feb.structure` checks files by.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from febio_io.xplt.elements import ELEMENT_TYPES


@dataclass(frozen=True)
class Tag:
    """One kind of element: its attributes, and the elements it may hold; without any it holds text.

    Attributes
    ----------
    required, optional : tuple of str
        Names of attributes.
    children : mapping of str to Tag
        By their names.
    types : mapping of str to tuple of str
        Where the attribute "type" decides: names of the parameters of each type.
    """

    required: tuple[str, ...] = ()
    optional: tuple[str, ...] = ()
    children: Mapping[str, "Tag"] = field(default_factory=lambda: MappingProxyType({}))
    types: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: MappingProxyType({}))


NODES_OF_ELEMENT = {
    element.name: element.nodes for element in ELEMENT_TYPES.values() if not element.name.startswith("line")
}
NODES_OF_FACET = {"tri3": 3, "tri6": 6, "tri7": 7, "quad4": 4, "quad8": 8, "quad9": 9}
PARAMETER = Tag(optional=("lc", "type"))
_TEXT = Tag()


def _texts(*names: str) -> dict[str, Tag]:
    return dict.fromkeys(names, _TEXT)


_STEPPER = _texts("max_retries", "opt_iter", "dtmin", "dtmax", "aggressiveness", "cutback", "dtforce")
_QN = _texts("max_ups", "max_buffer_size", "cycle_buffer", "cmax")
_SOLVER = _texts(
    *("symmetric_stiffness", "equation_scheme", "equation_order", "optimize_bw", "lstol", "lsmin", "lsiter"),
    *("ls_check_jacobians", "max_refs", "check_zero_diagonal", "zero_diagonal_tol", "force_partition"),
    *("reform_each_time_step", "reform_augment", "diverge_reform", "min_residual", "max_residual", "dtol"),
    *("vtol", "ftol", "etol", "rtol", "rhoi", "predictor", "min_volume_ratio", "order"),
)
_CONTROL = {
    **_texts(
        "analysis", "time_steps", "step_size", "plot_zero_state", "plot_range", "plot_level", "plot_stride"
    ),
    **_texts("output_level", "output_stride", "adaptor_re_solve"),
    "time_stepper": Tag(("type",), children=_STEPPER),
    "solver": Tag(("type",), children={**_SOLVER, "qn_method": Tag(("type",), children=_QN)}),
}
_ELASTIC = dict.fromkeys(("neo-Hookean", "isotropic elastic"), ("density", "E", "v"))
_VISCOUS = {"Newtonian fluid": ("kappa", "mu"), "Carreau": ("mu0", "mui", "lambda", "n")}
_MATERIAL = Tag(
    ("id", "name", "type"),
    children={
        "solid": Tag(("type",), types=_ELASTIC),
        "fluid": Tag(
            ("type",),
            children={
                **dict.fromkeys(("density", "k"), PARAMETER),
                "viscous": Tag(("type",), types=_VISCOUS),
                "elastic": Tag(("type",), types={"linear": ()}),
            },
        ),
    },
    types={**_ELASTIC, "fluid-FSI": ()},
)
_MESH = {
    "Nodes": Tag((), ("name",), {"node": Tag(("id",))}),
    "Elements": Tag(("type", "name"), children={"elem": Tag(("id",))}),
    "NodeSet": Tag(("name",)),
    "ElementSet": Tag(("name",)),
    "Surface": Tag(("name",), children=dict.fromkeys(NODES_OF_FACET, Tag(("id",)))),
}
_DOFS = {
    "zero displacement": ("x_dof", "y_dof", "z_dof"),
    "zero fluid velocity": ("wx_dof", "wy_dof", "wz_dof"),
}
_ON_SURFACES = {
    "fluid pressure": ("pressure",),
    "fluid resistance": ("R", "pressure_offset"),
    "fluid RCR": ("R", "Rd", "capacitance", "pressure_offset", "initial_pressure", "Bernoulli"),
}
_LOADS = {
    "fluid normal velocity": (
        *("velocity", "prescribe_nodal_velocities", "parabolic", "prescribe_rim_pressure"),
    ),
    "fluid backflow stabilization": ("beta",),
    "fluid tangential stabilization": ("beta",),
    "fluid-FSI traction": (),
}
_CURVE = {**_texts("interpolate", "extend"), "points": Tag(children={"pt": _TEXT})}
_RECORD = Tag(("data",), ("name", "file", "delim", "format", "comments", "node_set", "elem_set"))
_OUTPUT = {
    "plotfile": Tag(("type",), children={"var": Tag(("type",), ("surface",)), "compression": _TEXT}),
    "logfile": Tag((), ("file",), {"node_data": _RECORD, "element_data": _RECORD}),
}
# A section that refers to another, to materials or the mesh, stands behind it.
SECTIONS = {
    "Module": Tag(("type",)),
    "Control": Tag(children=_CONTROL),
    "Globals": Tag(children={"Constants": Tag(children=_texts("T", "R", "P", "Fc"))}),
    "Material": Tag(children={"material": _MATERIAL}),
    "Mesh": Tag(children=_MESH),
    "MeshDomains": Tag(children={"SolidDomain": Tag(("name", "mat"), ("type",))}),
    "Boundary": Tag(
        children={"bc": Tag(("type",), ("name", "node_set", "surface"), types={**_DOFS, **_ON_SURFACES})}
    ),
    "Loads": Tag(children={"surface_load": Tag(("type", "surface"), ("name",), types=_LOADS)}),
    "LoadData": Tag(children={"load_controller": Tag(("id", "type"), ("name",), children=_CURVE)}),
    "Output": Tag(children=_OUTPUT),
}
VERSION = "4.0"

"""What FEBio 4.11 knows of the models (.feb) that this package writes, from its public source and manual.

Names that are not here may well be those of a plugin, of another kind of model or of a later version: nothing
is said against them, but that they have not been checked.
"""

import re

UNKNOWN = "unknown to FEBio 4.11"
READ_BY_FEBIO_4 = ("1.2", "2.0", "2.5", "3.0", "4.0")
CHECKED = ("2.5", "3.0", "4.0")
NODES_OF_FACET = {
    "tri3": 3,
    "tri6": 6,
    "tri7": 7,
    "tri10": 10,
    "quad4": 4,
    "quad8": 8,
    "quad9": 9,
    "line2": 2,
    "line3": 3,
}
SECTIONS = (
    *("Module", "Control", "Globals", "Material", "Mesh", "MeshDomains", "MeshData", "MeshAdaptor"),
    *("Boundary", "Initial", "Loads", "Contact", "Constraints", "Discrete", "Rigid", "Step", "LoadData"),
    *("Output", "Include", "Code"),
)
CHILDREN = {
    "Mesh": (
        *("Nodes", "Elements", "NodeSet", "Surface", "Edge", "ElementSet", "PartList", "SurfacePair"),
        "DiscreteSet",
    ),
    "MeshDomains": ("SolidDomain", "ShellDomain", "BeamDomain"),
    "Boundary": ("bc",),
    "Initial": ("ic",),
    "Loads": ("nodal_load", "surface_load", "edge_load", "body_load"),
    "Rigid": ("rigid_bc", "rigid_ic", "rigid_load", "rigid_connector"),
    "Step": ("step",),
    "LoadData": ("load_controller",),
    "Output": ("plotfile", "logfile"),
}
# Attributes that must be there; of several, one.
REQUIRED = {
    "SolidDomain": ("name", "mat"),
    "ShellDomain": ("name", "mat"),
    "BeamDomain": ("name", "mat"),
    "bc": ("type",),
    "surface_load": ("type", "surface"),
    "nodal_load": ("type", "node_set"),
    "load_controller": ("id", "type"),
}
_ELASTIC = ("density", "E", "v", "mat_axis")
_FLUID = ("density", "k", "viscous", "elastic")
# All that FEBio 4.11 reads in what models of arteries (of this module; others know the same names with other
# parameters) are made of; "" is a tag without a type.
KNOWN_MODULE = "fluid-FSI"
PARAMETERS: dict[str, dict[str, tuple[str, ...]]] = {
    "material": {
        "neo-Hookean": _ELASTIC,
        "isotropic elastic": _ELASTIC,
        "fluid-FSI": ("solid", "fluid"),
        "fluid": _FLUID,
    },
    "solid": {"neo-Hookean": _ELASTIC, "isotropic elastic": _ELASTIC},
    "fluid": {"": _FLUID, "fluid": _FLUID},
    "viscous": {"Newtonian fluid": ("kappa", "mu"), "Carreau": ("mu0", "mui", "lambda", "n")},
    "bc": {
        "zero displacement": ("x_dof", "y_dof", "z_dof"),
        "zero fluid velocity": ("wx_dof", "wy_dof", "wz_dof"),
        "zero fluid dilatation": (),
        "fluid pressure": ("pressure",),
        "fluid resistance": ("R", "pressure_offset"),
        "fluid RCR": ("R", "Rd", "capacitance", "pressure_offset", "initial_pressure", "Bernoulli"),
    },
    "surface_load": {
        "fluid normal velocity": (
            *("velocity", "prescribe_nodal_velocities", "parabolic", "prescribe_rim_pressure", "value"),
        ),
        "fluid backflow stabilization": ("beta",),
        "fluid tangential stabilization": ("beta",),
        "fluid-FSI traction": ("shell_bottom",),
    },
}
_ELEMENT = re.compile(
    r"(?:hex|penta|pyra|tet|quad|tri|truss|line)(\d{1,2})s?"  # hex8, and tri3s of rigid shells
    r"|(?:HEX|PENTA|TET|QUAD|TRI)(\d{1,2})G\w+"  # with their integration rule
    r"|q(4)(?:eas|ans|s)|ut(4)"  # shells, and the tetrahedron of nodal strain
)


def nodes_of_element(kind: str) -> int | None:
    """Give the number of nodes of a type of elements; None if FEBio has no such type."""
    match = _ELEMENT.fullmatch(kind)
    return next(int(digits) for digits in match.groups() if digits) if match else None

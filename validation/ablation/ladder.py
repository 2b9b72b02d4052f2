"""The models between the thesis's and the coupled one, each a change of one thing, from any case."""

from cases.sections.case import Case
from cases.sections.solver import SemiImplicitSolver
from cases.sections.wall import MembraneOnLaws, MembraneWall, SolidWall, Wall, row_wall
from cases.sections.wall_laws import LAWS
from cases.sections.wall_laws.law import HomogeneousWall, WallLaw
from validation.errors import ValidationError


def models_between(case: Case) -> dict[str, Case]:
    """Return a case by wall and pressure: rows of springs, a whole wall, one pressure a section, both.

    Parameters
    ----------
    case : Case
        Of the semi-implicit scheme, with any wall.

    Returns
    -------
    dict of str to Case
        By words for people, from the thesis's model to the coupled one.

    Raises
    ------
    ValidationError
        For another scheme, or a wall without a Poisson's ratio.
    """
    solver = case.solver
    if not isinstance(solver, SemiImplicitSolver):
        raise ValidationError("solver.scheme: the models compared need semi_implicit")
    own = row_wall(case.wall)
    whole: dict[str, Wall] = {"membrane": _membrane(case.wall)}
    if isinstance(case.wall, SolidWall):
        whole["solid"] = case.wall
    walls = {**_of_linear_laws(own), own.law: own, **whole}
    by_rows, by_sections = (solver.model_copy(update={"pressure": kind}) for kind in ("row", "section"))
    found = {
        f"{name} wall, row pressure": case.model_copy(update={"wall": wall, "solver": by_rows})
        for name, wall in walls.items()
    }
    for name in (own.law, *whole):
        changed = {"wall": walls[name], "solver": by_sections}
        found[f"{name} wall, section pressure"] = case.model_copy(update=changed)
    return found


def coupled_model(case: Case) -> Case:
    """Return a case with the coupled model: its wall a membrane, one pressure a section.

    Raises
    ------
    ValidationError
        For another scheme than semi_implicit, or a wall without a Poisson's ratio.
    """
    if not isinstance(case.solver, SemiImplicitSolver):
        raise ValidationError("solver.scheme: the coupled model needs semi_implicit")
    solver = case.solver.model_copy(update={"pressure": "section"})
    return case.model_copy(update={"wall": _membrane(case.wall), "solver": solver})


def _of_linear_laws(wall: WallLaw) -> dict[str, Wall]:
    """Return a linear wall of one material by every such law; nothing for another wall.

    A law that has a Poisson's ratio of its own keeps it: the thin wall is the thesis's.
    """
    if not wall.linear or not isinstance(wall, HomogeneousWall):
        return {}
    stated = {key: getattr(wall, key) for key in HomogeneousWall.model_fields}
    return {
        name: law.model_construct(None, **stated | _own(law) | {"law": name})
        for name, law in LAWS.items()
        if law.linear and law.model_fields.keys() == stated.keys()
    }


def _own(law: type[WallLaw]) -> dict[str, float]:
    ratio = law.model_fields["poisson_ratio"]
    return {} if ratio.is_required() else {"poisson_ratio": ratio.default}


def _membrane(wall: Wall) -> MembraneWall:
    if isinstance(wall, MembraneWall):
        return wall
    wall = row_wall(wall)
    stated = {key: getattr(wall, key) for key in type(wall).model_fields}
    if "poisson_ratio" not in stated:
        raise ValidationError(f"wall: a membrane on a {wall.law} needs a poisson_ratio; state law membrane")
    return MembraneOnLaws.model_construct(None, **(stated | {"law": "membrane", "base": wall.law}))

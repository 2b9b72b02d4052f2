"""The registry of wall laws, a module each: what ``wall.law`` and a membrane's ``base`` may be.

They take NumPy where they compute: who only checks a case file need not wait for it.
"""

from cases.sections.wall_laws.law import WallLaw
from cases.sections.wall_laws.layered import LayeredWall
from cases.sections.wall_laws.neo_hookean import NeoHookeanWall
from cases.sections.wall_laws.saint_venant_kirchhoff import SaintVenantKirchhoffWall
from cases.sections.wall_laws.table import TableWall
from cases.sections.wall_laws.thick import ThickWall
from cases.sections.wall_laws.thin import ThinWall

LAWS: dict[str, type[WallLaw]] = {
    "thin": ThinWall,
    "thick": ThickWall,
    "layered": LayeredWall,
    "saint_venant_kirchhoff": SaintVenantKirchhoffWall,
    "neo_hookean": NeoHookeanWall,
    "table": TableWall,
}

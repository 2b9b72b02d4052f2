"""Manufactured 3D references: a tube of finite elements with known wall, velocity, flow and pressure.

The mesh is built like those of the real runs: sectors around the axis, one ring of wedges, rings of
hexahedra, wall layers, stacks along the axis; or the same split into tetrahedra. Nodes lie on rays and
are displaced along them, so that a node at the share η of the radius stays at that share.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from validation.mapping.elements import HEXAHEDRON, TETRAHEDRON, WEDGE
from validation.mapping.mesh import Block, LumenMesh, lumen_mesh
from validation.mapping.rays import Rays, rays

TURN = 2 * np.pi


@dataclass(frozen=True)
class Tube:
    """A tube of length and radius 15 mm and 2.5 mm; the wall is 0.5 mm thick.

    The fields are formulas of x, φ and η; u, γ are such that the axial velocity is single on the axis.
    """

    sectors: int = 24
    rings: int = 8
    stacks: int = 30
    layers: int = 3
    tetrahedra: bool = False
    length: float = 15e-3
    radius: float = 2.5e-3
    thickness: float = 0.5e-3
    bulge: float = 0.08
    skew: float = 0.06
    exponent: float = 2.2
    exponent_change: float = 0.4

    def finer(self, factor: int) -> "Tube":
        return replace(
            self, sectors=factor * self.sectors, rings=factor * self.rings, stacks=factor * self.stacks
        )

    def wall(self, x, phi):
        """R(x, φ)."""
        along = np.sin(np.pi * x / self.length) ** 2
        return self.radius * (1.05 + self.bulge * along + self.skew * along * np.cos(phi - 0.4))

    def gamma(self, x, phi):
        return self.exponent + self.exponent_change * np.sin(2 * phi + 0.3) * np.cos(np.pi * x / self.length)

    def centre_velocity(self, x):
        return 0.2 + 0.05 * np.cos(np.pi * x / self.length)

    def mean_velocity(self, x, phi):
        """u(x, φ), with u s(0; γ) the same for all φ."""
        gamma = self.gamma(x, phi)
        return self.centre_velocity(x) * gamma / (gamma + 2)

    def axial(self, x, phi, eta):
        return self.centre_velocity(x) * (1 - eta ** self.gamma(x, phi))

    def radial(self, x, phi, eta):
        return 0.02 * eta * (1 + 0.3 * np.cos(phi)) * np.sin(np.pi * x / self.length)

    def azimuthal(self, x, phi, eta):
        return 0.03 * eta * (1 - eta) * np.sin(phi) + 0.005 * eta

    def pressure(self, x):
        return 13e3 - 4e4 * x

    def flow_rate(self, x):
        """½∫ u R² dφ."""
        phi = np.arange(720) * TURN / 720
        return TURN * np.mean(0.5 * self.mean_velocity(x, phi) * self.wall(x, phi) ** 2)

    def area(self, x):
        return TURN * np.mean(0.5 * self.wall(x, np.arange(720) * TURN / 720) ** 2)

    @cached_property
    def _stations(self):
        """(x, φ, r) of the nodes in the reference configuration; plane by plane, axis first."""
        shares = np.arange(1, self.rings + 1) / self.rings * self.radius
        layers = self.radius + np.arange(1, self.layers + 1) / self.layers * self.thickness
        r = np.append(0.0, np.repeat(np.concatenate([shares, layers]), self.sectors))
        phi = np.append(0.0, np.tile(np.arange(self.sectors) * TURN / self.sectors, self.rings + self.layers))
        x = np.repeat(np.linspace(0.0, self.length, self.stacks + 1), r.size)
        return x, np.tile(phi, self.stacks + 1), np.tile(r, self.stacks + 1)

    @cached_property
    def coordinates(self):
        return _cartesian(*self._stations)

    @cached_property
    def displacement(self):
        x, phi, r = self._stations
        wall, eta = self.wall(x, phi), self._eta
        deformed = np.where(r <= self.radius * (1 + 1e-9), eta * wall, r + wall - self.radius)
        return _cartesian(x, phi, deformed) - self.coordinates

    @property
    def _eta(self):
        return np.minimum(self._stations[2] / self.radius, 1.0)

    @cached_property
    def velocity(self):
        """Nodal velocity, of the blood in the lumen and of the interface in the wall."""
        x, phi, _ = self._stations
        eta = self._eta
        radial, azimuthal = self.radial(x, phi, eta), self.azimuthal(x, phi, eta)
        cosine, sine = np.cos(phi), np.sin(phi)
        across = (radial * cosine - azimuthal * sine, radial * sine + azimuthal * cosine)
        return np.column_stack([self.axial(x, phi, eta), *across])

    @cached_property
    def nodal_pressure(self):
        return self.pressure(self._stations[0])

    @cached_property
    def lumen(self) -> list[Block]:
        core, rest, _ = self._blocks
        return self._split(core, rest) if self.tetrahedra else [Block(WEDGE, core), Block(HEXAHEDRON, rest)]

    @cached_property
    def vessel_wall(self) -> list[Block]:
        wall = self._blocks[2]
        none = np.empty((0, 6), dtype=np.int64)
        return self._split(none, wall) if self.tetrahedra else [Block(HEXAHEDRON, wall)]

    @cached_property
    def _blocks(self):
        """Wedges at the axis, hexahedra of the lumen, hexahedra of the wall."""
        a = np.arange(self.sectors)
        b = (a + 1) % self.sectors
        per_plane = 1 + (self.rings + self.layers) * self.sectors
        core = np.column_stack([np.zeros_like(a), a + 1, b + 1])
        corners = 1 + np.column_stack([a, a + self.sectors, b + self.sectors, b])
        quads = [corners + ring * self.sectors for ring in range(self.rings + self.layers - 1)]
        lumen, wall = np.concatenate(quads[: self.rings - 1]), np.concatenate(quads[self.rings - 1 :])
        return tuple(_extruded(base, per_plane, self.stacks) for base in (core, lumen, wall))

    def _split(self, wedges, hexahedra) -> list[Block]:
        halves = [hexahedra[:, [0, 1, 2, 4, 5, 6]], hexahedra[:, [0, 2, 3, 4, 6, 7]]]
        return [Block(TETRAHEDRON, _tetrahedra(np.concatenate([wedges, *halves]), self.coordinates))]

    @cached_property
    def mesh(self) -> LumenMesh:
        return lumen_mesh(self.coordinates, self.lumen, self.vessel_wall)

    def cells(self, n_x: int, n_phi: int) -> Rays:
        """Rays at the centres of n_x × n_phi cells."""
        x = (np.arange(n_x) + 0.5) * self.length / n_x
        return rays(x, (np.arange(n_phi) + 0.5) * TURN / n_phi)


SHORT = Tube(sectors=8, rings=2, stacks=6, layers=1)


def _cartesian(x, phi, r):
    return np.column_stack([x, r * np.cos(phi), r * np.sin(phi)])


def _extruded(base, per_plane, stacks):
    planes = np.arange(stacks)[:, None, None] * per_plane
    return np.concatenate([base + planes, base + planes + per_plane], axis=2).reshape(-1, 2 * base.shape[1])


def _tetrahedra(wedges, coordinates):
    """Three tetrahedra a wedge; diagonals run from the lower node number, so that neighbours agree."""
    bottom = np.sort(wedges[:, :3], axis=1)
    a, b, c = bottom.T
    d, e, f = (bottom + (wedges[:, 3:4] - wedges[:, 0:1])).T
    nodes = np.concatenate([np.column_stack(four) for four in ((a, b, c, f), (a, b, e, f), (a, d, e, f))])
    edges = coordinates[nodes[:, 1:]] - coordinates[nodes[:, :1]]
    mirrored = np.linalg.det(edges) < 0
    nodes[mirrored] = nodes[mirrored][:, [1, 0, 2, 3]]
    return nodes

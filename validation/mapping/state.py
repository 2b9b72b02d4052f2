"""One deformed state of a 3D simulation on the rays of the cells."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from cases.arrays import Floats, Integers
from validation.errors import UnusableReferenceError
from validation.mapping import interpolation
from validation.mapping.interpolation import Located
from validation.mapping.mesh import LumenMesh
from validation.mapping.nodal_shares import TwoRings, nodal_shares, two_rings
from validation.mapping.rays import Rays
from validation.mapping.surface import area_across_axis, flow_along_axis, flux
from validation.mapping.wall_radius import interface_radius


class MappedState(NamedTuple):
    """Values of one state, SI.

    ``radius``, ``chord`` (n_x, n_phi): wall radius and the ray's end in the mesh; ``sector_area``
    (n_x, n_phi): 2/Δφ times the area of each sector of the mesh's lumen, R² for a circle, m²;
    ``velocity`` (n_x, n_phi, n_y, 3): along x, r, φ; ``rings`` (n_x, n_phi, n_y): nodes around the points;
    ``pressure`` (n_x, n_phi): ray mean;
    ``pressure_range`` (n_x,): largest minus least over all points of a section; ``inflow``, ``outflow``,
    ``wall_flow``: flow rates through the boundary by surface integral, m³/s; ``inlet_area``: m².
    """

    radius: Floats
    chord: Floats
    sector_area: Floats
    velocity: Floats
    rings: TwoRings
    pressure: Floats
    pressure_range: Floats
    inflow: float
    outflow: float
    wall_flow: float
    inlet_area: float


@dataclass
class Mapper:
    """Maps states one after the other, each starting from where the last one found its points."""

    mesh: LumenMesh
    rays: Rays
    _located: Located = field(init=False)
    _faces: Integers = field(init=False)
    _chord_faces: Integers = field(init=False)
    _rim_faces: Integers = field(init=False)
    _node_faces: Integers = field(init=False)

    def __post_init__(self) -> None:
        n_x, n_phi, n_y = self.rays.shape
        count = n_x * n_phi * n_y
        self._located = Located(np.full(count, -1, dtype=np.int64), np.zeros((count, 3)))
        self._faces = np.zeros((n_x, n_phi), dtype=np.int64)
        self._chord_faces = np.zeros((n_x, n_phi), dtype=np.int64)
        self._rim_faces = np.zeros((n_x, self.rays.rim.size), dtype=np.int64)
        self._node_faces = np.zeros(self.mesh.lumen_nodes.size, dtype=np.int64)

    def map_state(self, points: Floats, velocity: Floats, pressure: Floats) -> MappedState:
        """Bring nodal values onto the rays.

        Parameters
        ----------
        points, velocity : ndarray (n_nodes, 3)
            Deformed nodes, m, and velocity, m/s, in the artery's frame.
        pressure : ndarray (n_nodes,)
            Pa.

        Raises
        ------
        UnusableReferenceError
            If a ray misses the wall, or a point on it lies in no lumen element.
        """
        mesh, rays = self.mesh, self.rays
        radius = self._radius(points, rays.phi, self._faces, chord=False)
        chord = self._radius(points, rays.phi, self._chord_faces, chord=True)
        rim = self._radius(points, rays.rim, self._rim_faces, chord=True)
        targets = rays.points(chord)
        shapes = interpolation.deformed(mesh.lumen, points)
        missing = interpolation.locate(mesh.lumen, shapes, targets.reshape(-1, 3), self._located)
        if missing >= 0:
            i, j, k = np.unravel_index(missing, rays.shape)
            raise UnusableReferenceError(
                f"no lumen element holds the point at x = {rays.x[i]:.6g} m, φ = {rays.phi[j]:.4g} rad, "
                f"r/R = {rays.y[k]:.3g}"
            )
        share = nodal_shares(points, mesh, radius, rays, self._node_faces)
        nodal = np.column_stack([velocity, pressure, share, share**2, share**3])
        values = interpolation.interpolate(mesh.lumen, nodal, self._located).reshape(*rays.shape, 7)
        return MappedState(
            radius=radius,
            chord=chord,
            sector_area=(rim**2).reshape(*radius.shape, -1).mean(axis=-1),
            velocity=rays.cylindrical(values[..., :3]),
            rings=two_rings(values[..., 4:]),
            pressure=rays.mean(values[..., 3]),
            pressure_range=np.ptp(values[..., 3], axis=(1, 2)),
            inflow=flow_along_axis(points, mesh.inlet, velocity),
            outflow=flow_along_axis(points, mesh.outlet, velocity),
            wall_flow=float(flux(points, mesh.interface, velocity)),
            inlet_area=area_across_axis(points, mesh.inlet),
        )

    def _radius(self, points: Floats, phi: Floats, guess: Integers, chord: bool) -> Floats:
        rays = self.rays
        radius = interface_radius(points, self.mesh.interface, rays.x, phi, chord, guess)
        missed = np.argwhere(radius <= 0)
        if len(missed):
            i, j = missed[0]
            raise UnusableReferenceError(
                f"the ray at x = {rays.x[i]:.6g} m, φ = {phi[j]:.4g} rad meets no lumen–wall interface"
            )
        return radius

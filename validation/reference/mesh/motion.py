"""Whether positions and velocities of a series belong together, by what their values show at the wall."""

from dataclasses import dataclass, field

import numpy as np

from cases.arrays import Floats
from validation.errors import UnusableReferenceError
from validation.mapping.mesh import LumenMesh
from validation.reference.mesh.series import MeshState

SPREAD = 0.05  # share of the lumen's length by which its nodes may leave the span of its wall
STILL = 1e-9  # share of the radius below which the wall has not moved
SLOW = 1e-3  # share of the blood's speed below which the wall's tells nothing
ABSOLUTE = 0.5  # share of the wall's speed from which velocity at the wall counts as absolute
SLIP = 0.2  # share of the blood's axial velocity from which it slips along the wall


def check_spread(state: MeshState, mesh: LumenMesh, number: int) -> None:
    """Refuse positions of the lumen that leave its wall: paths of the blood, not those of the mesh."""
    wall, lumen = (state.positions[nodes, 0] for nodes in (mesh.interface_nodes, mesh.lumen_nodes))
    beyond = max(lumen.max() - wall.max(), wall.min() - lumen.min())
    if beyond > SPREAD * mesh.length:
        raise UnusableReferenceError(
            f"state {number + 1}: nodes of the lumen are up to {beyond:.3g} m beyond the ends of its wall, "
            f"which is {mesh.length:.3g} m long: the wall does not move with the lumen; positions must be "
            "those of the mesh, not where the blood has flowed to"
        )


@dataclass
class WallMotion:
    """Speed of the interface by its positions beside the velocity there, summed state after state."""

    mesh: LumenMesh
    _before: list[tuple[float, Floats, Floats]] = field(default_factory=list)
    _products: Floats = field(default_factory=lambda: np.zeros(3))
    _axial: Floats = field(default_factory=lambda: np.zeros(2))
    _moved: float = 0.0

    def add(self, time: float, state: MeshState) -> None:
        """Take a state; the wall's speed at the one before is the central difference."""
        nodes = self.mesh.interface_nodes
        here, velocity = state.positions[nodes], state.velocity[nodes]
        blood = state.velocity[self.mesh.lumen_nodes, 0]
        self._axial += np.mean(velocity[:, 0] ** 2), np.mean(blood**2)
        if self._before:
            self._moved = max(self._moved, float(np.abs(here - self._before[0][1]).max()))
        if len(self._before) == 2:
            (first, then, _), (_, _, between) = self._before
            speed = (here - then) / (time - first)
            self._products += np.sum(between * speed), np.sum(speed**2), nodes.size * np.mean(blood**2)
            self._before.pop(0)
        self._before.append((time, here, velocity))

    @property
    def still(self) -> bool:
        """Whether the wall has not moved."""
        return self._moved <= STILL * self.mesh.length

    def doubts(self) -> list[str]:
        """Say what cannot be: relative velocity, and slip."""
        found = []
        both, speed, blood = self._products
        if not self.still and speed > SLOW**2 * blood and both < ABSOLUTE * speed:
            found.append(
                f"at the wall, velocity is {both / speed:.0%} of the speed at which positions move there: it "
                "is relative to the mesh, or positions are not those of the mesh; it must be absolute"
            )
        along, mean = self._axial
        if along > SLIP**2 * mean:
            found.append(
                f"blood slips along the wall: axial velocity there is {np.sqrt(along / mean):.0%} of the "
                "lumen's (root of the mean square)"
            )
        return found

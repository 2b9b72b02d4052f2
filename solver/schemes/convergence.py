"""How far an iteration still is from its limit (numba kernel)."""

import numpy as np

from solver.schemes.vectorisation import kernel

FASTEST_RATIO = 0.05  # of two changes: an iteration is not taken to converge faster than this


@kernel
def remaining(change: float, before: float) -> float:
    """Error left after a change that followed another: the rest of their geometric series."""
    ratio = max(change / before, FASTEST_RATIO) if change < before else 1.0
    return change * ratio / (1.0 - ratio) if ratio < 1.0 else np.inf

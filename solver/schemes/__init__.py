"""Time-stepping schemes: numba kernels on plain float64 arrays in SI units."""

from pathlib import Path

from solver.kernel_cache import keep_kernels

keep_kernels([Path(__file__).parent])

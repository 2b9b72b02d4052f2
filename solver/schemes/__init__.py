"""Time-stepping schemes: numba kernels on plain float64 arrays in SI units."""

from solver.kernel_cache import keep_kernels
from solver.schemes import vectorisation

keep_kernels()
vectorisation.compare_rows()

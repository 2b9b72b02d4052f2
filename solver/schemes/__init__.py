"""Time-stepping schemes: numba kernels on plain float64 arrays in SI units."""

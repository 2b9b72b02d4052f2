"""The split explicit Godunov scheme: numba kernels."""

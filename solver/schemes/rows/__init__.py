"""The semi-implicit scheme with a pressure in every row: numba kernels."""

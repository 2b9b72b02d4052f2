"""The semi-implicit scheme with one pressure a section: numba kernels."""

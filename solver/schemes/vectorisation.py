"""How kernels are compiled: so that loops over φ become vector instructions.

Before a vector loop LLVM compares its arrays for overlap. Two of its defaults do not suit these schemes,
whose sweeps touch a dozen arrays row by row: it gives up beyond eight arrays, and compares whole arrays
instead of rows, so that a loop that reads one row and writes the next of the same array stays scalar.

A product and a sum may become one instruction, which rounds once; only sums declared so may be reordered.
"""

from llvmlite import binding  # type: ignore[import-untyped]
from numba import njit

MOST_OVERLAP_CHECKS = 256

kernel = njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
inlined_kernel = njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"}, forceinline=True)
summing_kernel = njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "reassoc"})


def compare_rows() -> None:
    """Set LLVM's limits for this process; it takes them once only, before the first kernel is compiled."""
    binding.set_option("solver", f"-runtime-memory-check-threshold={MOST_OVERLAP_CHECKS}")
    binding.set_option("solver", "-hoist-runtime-checks=false")

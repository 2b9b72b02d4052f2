"""How kernels are compiled: so that loops over φ become vector instructions.

Before a vector loop LLVM compares its arrays for overlap. Two of its defaults do not suit these schemes,
whose sweeps touch a dozen arrays row by row: it gives up beyond eight arrays, and compares whole arrays
instead of rows, so that a loop that reads one row and writes the next of the same array stays scalar.

A product and a sum may become one instruction, which rounds once; only sums declared so may be reordered.
"""

from collections.abc import Callable
from typing import Any, TypeVar

from llvmlite import binding  # type: ignore[import-untyped]
from numba import njit

MOST_OVERLAP_CHECKS = 256

Function = TypeVar("Function", bound=Callable[..., object])


def _compiled(**options: Any) -> Callable[[Function], Function]:
    """Decorator ``njit`` with options that its types leave out."""
    decorator: Callable[[Function], Function] = njit(nogil=True, error_model="numpy", **options)
    return decorator


_KEPT = {"cache": True, "no_cfunc_wrapper": True}  # nothing calls a kernel by its C address
kernel = _compiled(**_KEPT, fastmath={"contract"})
inlined_kernel = _compiled(**_KEPT, fastmath={"contract"}, forceinline=True)
summing_kernel = _compiled(**_KEPT, fastmath={"contract", "reassoc"})
# written out in its caller: as a kernel of its own it would be optimised once more with all that it calls
part_of_kernel = _compiled(fastmath={"contract"}, inline="always")


def compare_rows() -> None:
    """Set LLVM's limits for this process; it takes them once only, before the first kernel is compiled."""
    binding.set_option("solver", f"-runtime-memory-check-threshold={MOST_OVERLAP_CHECKS}")
    binding.set_option("solver", "-hoist-runtime-checks=false")

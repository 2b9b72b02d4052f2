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
    """Decorator ``njit`` with options that its types leave out.

    Where ``fastmath``, ``error_model``, ``forceinline`` or ``_nrt`` is not stated, numba takes it from
    the caller for which a kernel is compiled first (0.68.1, ``CPUTargetOptions.finalize``), and keeps the
    result for all others: digits would depend on what ran first. So every kernel states all four. Without
    ``_nrt`` it counts no references to the arrays of its arguments, which halves the time to compile one
    that passes on tuples of forty, and cannot make arrays of its own.
    """
    stated: dict[str, Any] = {"error_model": "numpy", "fastmath": False, "forceinline": False, "_nrt": False}
    stated |= options
    decorator: Callable[[Function], Function] = njit(nogil=True, **stated)
    return decorator


_KEPT = {"cache": True, "no_cfunc_wrapper": True}  # nothing calls a kernel by its C address
exact_kernel = _compiled(**_KEPT)
kernel = _compiled(**_KEPT, fastmath={"contract"})
summing_kernel = _compiled(**_KEPT, fastmath={"contract", "reassoc", "nsz"}, _nrt=True)
allocating_kernel = _compiled(**_KEPT, fastmath={"contract"}, _nrt=True)
exact_allocating_kernel = _compiled(**_KEPT, _nrt=True)
# called by kernels only, and within them
inlined_kernel = _compiled(**_KEPT, fastmath={"contract"}, forceinline=True, no_cpython_wrapper=True)
# written out in their caller: kernels of their own would be optimised once more with all that they call
part_of_kernel = _compiled(fastmath={"contract"}, inline="always")
exact_part_of_kernel = _compiled(inline="always")


def compare_rows() -> None:
    """Set LLVM's limits for this process; it takes them once only, before the first kernel is compiled."""
    binding.set_option("solver", f"-runtime-memory-check-threshold={MOST_OVERLAP_CHECKS}")
    binding.set_option("solver", "-hoist-runtime-checks=false")

"""Let LLVM vectorise loops over many arrays.

Before a vector loop LLVM inserts comparisons that its arrays do not overlap, and gives up beyond eight
of them. The sweeps of these schemes touch a dozen arrays over hundreds of cells, where the comparisons
cost nothing.
"""

from llvmlite import binding  # type: ignore[import-untyped]

MOST_OVERLAP_CHECKS = 256


def allow_overlap_checks() -> None:
    """Raise LLVM's limit for this process; LLVM takes it once only, before the first kernel is compiled."""
    binding.set_option("solver", f"-runtime-memory-check-threshold={MOST_OVERLAP_CHECKS}")

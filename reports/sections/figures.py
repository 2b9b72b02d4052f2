"""Section of every figure of a comparison, for a page with scripts."""

from reports.blocks import Interactive
from reports.result.load import Comparison
from reports.sections.declaration import Blocks, declared
from reports.sections.parts.page_data import metric_columns


@declared("figures", "Every figure of this comparison", appendix=True)
def section(comparison: Comparison) -> Blocks:
    """Return all rows of metrics.json."""
    return (
        Interactive(
            "metrics-all",
            "metrics",
            "Every figure of this comparison",
            "All rows of metrics.json; errors are relative to 3D. Choose what to see; a "
            "click on a heading sorts.",
            {"metrics": metric_columns(comparison)},
        ),
    )

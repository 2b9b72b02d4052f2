"""The page of a sweep: many runs of the reduced model over ranges of its inputs."""

from reports.sweep.build import is_sweep, write_sweep_page

__all__ = ["is_sweep", "write_sweep_page"]

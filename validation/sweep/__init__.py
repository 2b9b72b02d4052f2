"""Sweeps: many runs of the reduced model over ranges and distributions of a case's numbers."""

"""The thesis's numerical experiments with the Godunov scheme, recomputed and held against its numbers."""

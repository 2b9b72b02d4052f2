"""From a 3D reference to cells, profiles, metrics and bands; the comparison command."""

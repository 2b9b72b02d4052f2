"""The semi-implicit scheme for profiles of two modes, whose axis velocity D may be an unknown."""

"""Numbers of a case fitted to pressures or to a 3D run."""

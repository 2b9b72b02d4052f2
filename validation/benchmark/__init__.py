"""How fast the solver is on this machine."""

"""How much of a difference is the 2D model's own grid and time step."""

"""What a run is made of: parameters, ends, signals, velocity profiles, and what is watched of a state."""

"""What a difference between both models owes to inflow, meshes, steps, inputs and model."""

"""From one instant to the next: the steppers that hold a state in the kernels' arrays, and steady states."""

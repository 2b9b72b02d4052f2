"""The wall: stiffness of each law, tables of nonlinear laws, the membrane, and what a whole section sees."""

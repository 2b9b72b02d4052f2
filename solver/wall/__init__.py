"""The wall: stiffness of each law, tables of nonlinear laws, membrane, solid, and what a section sees."""

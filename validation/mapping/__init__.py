"""From a deformed 3D mesh to cells, rays and profiles: kernels and geometry; no file, no case."""

"""Where 3D data comes from: kinds of reference, a module or folder each."""

"""The 3D results that a case is compared with: a module for each kind, and the registry of kinds."""

"""A finished comparison's directory, read and checked before anything is drawn."""

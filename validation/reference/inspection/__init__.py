"""What files of a 3D result hold, and what of it is what, guessed by names and values."""

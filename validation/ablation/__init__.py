"""What each part of the coupled model buys against 3D, from the thesis's model to the coupled one."""

"""Where things are on the artery: the grid on (x, φ), calcified patches, symmetric rows, spatial angles."""

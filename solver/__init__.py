"""The 2D reduced-order model of an artery: lumen and wall on (x, φ), velocity profiles along r."""

"""The 2D reduced-order model of an artery: lumen and wall on (x, φ), a family of velocity profiles along r."""

"""Pictures as SVG, drawn once for both renderings."""

"""Figures of a comparison as rows: statistics, bands, confidence, what calcification changes."""

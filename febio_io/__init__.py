"""Readers for FEBio's files."""

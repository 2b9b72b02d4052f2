"""Sections of a report: an ordered list, a module each."""

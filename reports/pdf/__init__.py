"""The report as a typeset PDF."""

"""FEBio's text files: logs, and data records (``<logfile>``)."""

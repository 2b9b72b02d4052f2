"""One report, in HTML and PDF, from a finished comparison; a page from a sweep."""

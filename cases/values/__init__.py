"""What keys hold: quantities with units, ranges, files of columns, and the words that say what is allowed."""

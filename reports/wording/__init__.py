"""Words and formats of quantities, numbers, places and tables."""

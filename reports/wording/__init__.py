"""How quantities, numbers, places and tables are written."""

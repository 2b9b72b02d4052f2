"""References that are states of a deforming mesh: what they share, whatever solver wrote them."""

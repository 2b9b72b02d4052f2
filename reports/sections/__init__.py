"""What a report says: an ordered list of sections, a module each."""

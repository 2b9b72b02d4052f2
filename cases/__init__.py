"""The case file: what a user states, its schema, its units, and the names of every quantity."""

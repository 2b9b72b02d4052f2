"""All that knows the case file: a checked case becomes a model and runs with the scheme that it names."""

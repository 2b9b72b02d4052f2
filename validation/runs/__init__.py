"""Both models of a variant at the same instants, from the cache or computed."""

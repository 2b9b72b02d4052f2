"""What all commands share: how they start and end, what they show meanwhile, and files written whole."""

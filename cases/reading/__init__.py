"""From YAML with its line numbers to checked cases, and from what is wrong to messages."""

"""Tables, sentences and data that sections are put together from."""

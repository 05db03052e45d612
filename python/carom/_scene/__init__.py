"""The lowest layer: scenes and what they are made of, as values."""

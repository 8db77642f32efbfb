"""Whether what is connected fits, and is what the model names."""

"""From answers to levels, effects of factors and carry-over."""

"""Studies with observers drawn by chance: coverage of intervals, and power."""

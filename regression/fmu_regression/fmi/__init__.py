"""FMUs opened through FMPy: descriptions, variables, instances."""

"""The report on a generation, its drawings and its notes."""

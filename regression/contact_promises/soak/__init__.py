"""Random small scenes at all tolerances: nothing gains energy, results converge, every run ends."""

"""The command line program of ContactMultiBody."""

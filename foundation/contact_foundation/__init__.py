"""What every Python package of ContactMultiBody shares: errors, progress and whole-or-nothing output."""

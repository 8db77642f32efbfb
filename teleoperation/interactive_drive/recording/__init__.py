"""Records of a drive: result.csv and the report."""

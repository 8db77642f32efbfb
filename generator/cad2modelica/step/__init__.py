"""STEP assemblies: parts from the file, joints from a file beside it or proposed from faces."""

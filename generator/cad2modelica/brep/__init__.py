"""STEP files through a CAD kernel that is an optional extra of the package."""

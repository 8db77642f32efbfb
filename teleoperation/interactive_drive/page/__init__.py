"""The page of a drive."""

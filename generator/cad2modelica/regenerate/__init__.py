"""What a second generation may change in a package that is there."""

"""What an FMU says about its model."""

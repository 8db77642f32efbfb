"""The project's assembly XML to the mechanism."""

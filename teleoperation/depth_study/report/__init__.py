"""Tables for the terminal and pages."""

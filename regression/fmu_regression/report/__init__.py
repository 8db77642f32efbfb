"""Pages, plots, animation and tables for people."""

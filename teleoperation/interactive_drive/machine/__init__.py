"""The FMU as a machine: stepped, steered, saved and restored."""

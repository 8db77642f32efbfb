"""The simulation in a process of its own, and what it and the server tell each other."""

"""A poor channel between the server and its pages, simulated: bandwidth, delay, jitter and loss."""

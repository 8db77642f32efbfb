"""A machine simulated in real time that people drive from a page in their browser."""

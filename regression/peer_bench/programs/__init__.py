"""One module a program; each is imported where its program is installed and nowhere else."""

"""What observers answered, and the database that keeps it."""

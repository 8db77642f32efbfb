"""What the library promises, measured: restitution over wide ranges, and the known answers at several tolerances."""

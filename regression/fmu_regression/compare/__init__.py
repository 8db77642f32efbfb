"""Results against references and known answers; accuracy against work."""

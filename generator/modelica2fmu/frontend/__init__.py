"""Has rumoca flatten a model, and reads the flattened form into typed classes."""

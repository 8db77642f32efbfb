"""The scene in a model: its bodies and contact managers, found by what they declare."""

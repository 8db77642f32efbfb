"""Mates between bodies, and joints that move as they allow."""

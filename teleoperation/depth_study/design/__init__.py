"""What a study is made of: factors, constellations, edges, and sequences for observers."""

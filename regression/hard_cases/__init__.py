"""Hard cases: random scenes over the whole range of every knob, and where the product holds."""

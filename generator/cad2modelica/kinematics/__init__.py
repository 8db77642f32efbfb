"""The mechanism as a graph: trees, loops, states, start motion and reach."""

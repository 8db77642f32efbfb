"""The same scenes in this project and in its peers: error against processor time, in one run on one machine."""

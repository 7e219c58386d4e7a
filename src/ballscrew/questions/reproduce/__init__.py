"""The figures of the paper, computed again, and the reference model on a preloaded nut."""

"""The figures of the paper, computed again."""

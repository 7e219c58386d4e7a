"""The preload that is left, from logs of two dates."""

"""Sweeps over grids of inputs, in memory, into stores on disk, and on a cluster."""

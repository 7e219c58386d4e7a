"""Supports of a screw and its table: support bearings, linear guides, and how far they give way."""

"""Interfaces: where the package talks to people and files. Units other than SI live here only."""

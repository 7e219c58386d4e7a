"""Notebooks: tables and pictures of results, cases, bands and sweeps."""

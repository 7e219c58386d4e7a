"""The model against vendors' tables and measurements."""

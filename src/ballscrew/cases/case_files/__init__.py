"""Case files: schema, fields, units, catalogue rows, overrides."""

"""The model handed over to simulators, robots and controls: one module per target, each with its worst error."""

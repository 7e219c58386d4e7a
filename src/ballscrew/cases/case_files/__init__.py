"""Case files: read, changed by settings, built into a model, a screw, an oil and an operating point."""

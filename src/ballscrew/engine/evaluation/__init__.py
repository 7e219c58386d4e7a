"""A model evaluated over many points: the plan, the outputs, the engine, derivatives, models side by side."""

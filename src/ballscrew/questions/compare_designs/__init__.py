"""Several cases side by side, with their checks and what differs."""

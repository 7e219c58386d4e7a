"""Options that commands share, and the bar that shows progress."""

"""The report to file, and the drawing of the ball between its grooves."""

"""What a screw and its table are held by: support bearings, linear guides, and how far they give way."""

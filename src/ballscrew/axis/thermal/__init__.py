"""Heat: how a screw and its nut warm up over a duty, what it does to oil, preload and growth, and where it ends."""

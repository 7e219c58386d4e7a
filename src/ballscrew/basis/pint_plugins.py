"""Plug-ins that pint would load; a module of its own because the command line sets it before NumPy is loaded."""

#: Libraries that pint would load where they are installed, though units do not need them. The command line
#: names some, and is half a second sooner there; a program of somebody else's may want pint to know them.
hidden_from_pint: list[str] = []

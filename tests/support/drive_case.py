"""The case of a preloaded feed drive as text: a catalogue row with a double nut."""


def drive_case(preload: str = "7 %", axial_load: str = "1 kN", screw_speed: str = "100 rpm", more: str = "") -> str:
    """A case file; ``more`` is the text of further tables."""
    return f"""
[screw]
catalogue = "rexroth-40x10x6-6-double"
[nut]
type = "double"
preload = "{preload}"
[lubricant]
grade = "ISO VG 100"
[operation]
axial_load = "{axial_load}"
screw_speed = "{screw_speed}"
{more}
"""

"""Screws of one's own, of no catalogue, as a case file has them: as text, and as a table."""

#: With an oil whose temperature a case may give below it.
WITH_OIL = """
[screw]
pitch_circle_diameter = "40 mm"
lead = "10 mm"
ball_diameter = "6 mm"
loaded_balls = 60
contact_angle = "45 deg"
screw_conformity = 0.54
nut_conformity = 0.54
[lubricant]
grade = "ISO VG 100"
"""
SCREW = {
    "pitch_circle_diameter": "41.4 mm", "lead": "10 mm", "ball_diameter": "6.35 mm", "loaded_balls": 75,
    "contact_angle": "45 deg", "screw_conformity": 0.54, "nut_conformity": 0.54,
}  # fmt: skip

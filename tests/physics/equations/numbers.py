"""The numbers of the paper's §8, and a few other screws to try a formula on."""

import math

#: Pitch circle diameter, ball diameter, contact angle, groove conformity.
SCREWS = {
    "paper": (0.040, 3.175e-3, math.pi / 4, 0.515),  # Olaru2005 §8
    "catalogue": (0.0414, 6.35e-3, math.radians(45), 0.54),  # HIWIN S99TE20-1610, 40-20K4 with usual groove
    "steep": (0.050, 9.0e-3, math.radians(30), 0.52),
    "slender": (0.200, 3.0e-3, math.radians(60), 0.53),
}

PITCH_CIRCLE_DIAMETER, BALL_DIAMETER, CONTACT_ANGLE, CONFORMITY = SCREWS["paper"]
LEAD = 0.005
LOADED_BALLS = 56
BALL_ROUGHNESS, RACE_ROUGHNESS = 0.08e-6, 0.3e-6
AXIAL_LOAD, VISCOSITY, RPM = 4000.0, 0.1, 600.0
BOUNDARY, DECAY, EXPONENT, FULL_FILM = 0.2, 1.42, 0.8, 0.02  # Olaru2005 §5
#: Not printed in the paper: steel on steel, and a mineral oil.
EQUIVALENT_MODULUS, PRESSURE_VISCOSITY = 2.26e11, 2.2e-8

CURVATURE_RATIO = BALL_DIAMETER * math.cos(CONTACT_ANGLE) / PITCH_CIRCLE_DIAMETER
CONTACT_LOAD = AXIAL_LOAD / (LOADED_BALLS * math.sin(CONTACT_ANGLE))
ROLLING_RADIUS = BALL_DIAMETER / 2 * (1 - CURVATURE_RATIO)
RADII_RATIO = CONFORMITY * BALL_DIAMETER / (2 * CONFORMITY - 1) / ROLLING_RADIUS

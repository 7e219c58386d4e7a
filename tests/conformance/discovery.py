"""Finds the equations, and says what is special about a few of them.

An equation is a public function defined in a module of ``ballscrew.physics.equations``, or in one of ``ELSEWHERE``.
A new one is tested here without being listed; only an exception has to be listed, with its reason.
"""

import dataclasses
import importlib
import inspect
import pkgutil
import zlib
from collections.abc import Callable, Mapping
from typing import Any, get_type_hints

import numpy as np

import ballscrew.physics.equations
from ballscrew.basis.quantities import unit_of


@dataclasses.dataclass(frozen=True)
class Equation:
    """A public function of ``ballscrew.physics.equations``."""

    name: str
    function: Callable[..., Any]

    @property
    def parameters(self) -> list[str]:
        return list(inspect.signature(self.function).parameters)

    @property
    def annotations(self) -> Mapping[str, Any]:
        return get_type_hints(self.function, include_extras=True)

    @property
    def units(self) -> dict[str, str | None]:
        """Unit of each parameter."""
        return {name: unit_of(self.annotations.get(name)) for name in self.parameters}

    @property
    def return_units(self) -> list[str | None]:
        """Unit of the result, or of each field of a NamedTuple."""
        returned = self.annotations["return"]
        if unit_of(returned) is None and hasattr(returned, "_fields"):
            fields = get_type_hints(returned, include_extras=True)
            return [unit_of(fields[name]) for name in returned._fields]
        return [unit_of(returned)]

    def sample(self, count: int) -> dict[str, np.ndarray]:
        """Values of each parameter within the domain of the equation, the same every time."""
        generator = np.random.default_rng(zlib.crc32(self.name.encode()))
        return {
            name: generator.uniform(*BY_PLACE.get(f"{self.name}.{name}", domain(name, unit)), count)
            for name, unit in self.units.items()
        }

    def __call__(self, *arguments: Any) -> list[Any]:
        """The results as a list: one, or one for each field of a NamedTuple."""
        result = self.function(*arguments)
        return list(result) if isinstance(result, tuple) else [result]


#: Modules of equations in the room that alone has a use for them.
ELSEWHERE = ("ballscrew.axis.supports.formulas",)


def discover() -> dict[str, Equation]:
    """All equations by ``module.function``."""
    found: dict[str, Equation] = {}
    names = [
        f"ballscrew.physics.equations.{each.name}"
        for each in pkgutil.iter_modules(ballscrew.physics.equations.__path__)
    ]
    for path in (*names, *ELSEWHERE):
        module = importlib.import_module(path)
        for name, function in inspect.getmembers(module, inspect.isfunction):
            if function.__module__ == module.__name__ and not name.startswith("_"):
                equation = Equation(f"{path.rpartition('.')[2]}.{name}", function)
                found[equation.name] = equation
    return found


EQUATIONS = discover()

#: No single formula: compared with mpmath instead (test_recurrences).
RECURRENCES = {
    "hertz.elliptic_integrals": "arithmetic-geometric mean, a fixed number of steps",
    "hertz.ellipticity": "Newton's method, a fixed number of steps",
}

#: Right in SI only, because a number in them has a unit that is not written (test_units).
DIMENSIONAL_FITS = {
    "formulas.bearing_centrifugal_load": "fit of a bearing maker in millimetres and revolutions a minute",
    "formulas.bearing_boundary_share": "fit of a bearing maker in millimetres, mm^2/s and revolutions a minute",
    "formulas.bearing_replenishment_factor": "fit of a bearing maker in millimetres, mm^2/s and revolutions a minute",
    "formulas.bearing_rolling_moment": "fit of a bearing maker in millimetres, mm^2/s and revolutions a minute",
    "formulas.bearing_sliding_moment": "fit of a bearing maker in millimetres",
    "formulas.inlet_heating_factor": "fit of a bearing maker in millimetres, mm^2/s and revolutions a minute",
    "formulas.palmgren_viscous_moment": "fit in millimetres, mm^2/s and revolutions a minute",
    "nut_losses.ball_drag_force_harris": "the exponent 1.95 of a speed",
    "rheology.pressure_viscosity_estimate": "fit of a pressure coefficient to a power of a viscosity",
    "rheology.pressure_modulus_slope_linear": "the 273.15 is kelvin, and the slope is per kelvin",
    "rheology.pressure_viscosity_linear": "the 273.15 is kelvin, and the slope is per kelvin",
    "rheology.roelands_exponent": "the logarithm is that of a viscosity in Pa s, and a number is in 1/Pa",
    "rheology.roelands_viscosity": "the logarithm is that of a viscosity in Pa s, and a number is in 1/Pa",
    "life.screw_turn_rating": "fit of a force to powers of a length and a number, in millimetres and newtons",
    "life.static_load_factor": "the 27.74 is in N/mm^2, a property of steel",
    "rheology.kinematic_viscosity_of_walther_number": "numbers in mm^2/s",
    "rheology.oil_expansion_coefficient": "the 0.6278 is in kg/(m^3 K)",
    "rheology.reference_viscosity": "coefficients of polynomials of a viscosity in mm^2/s",
    "rheology.refined_kinematic_viscosity": "numbers in mm^2/s",
    "rheology.viscosity_index_above_100": "the logarithm is that of a viscosity in mm^2/s",
    "rheology.walther_number": "numbers in mm^2/s",
    "rheology.walther_number_slope": "numbers in mm^2/s",
    "rheology.walther_temperature_coefficient": "numbers in mm^2/s",
    "rolling.replenishment_factor": "fit of a bearing maker in millimetres and revolutions a minute",
    "rolling.elastic_resistance_moment": "fit of a moment to powers of a length and a force",
}

#: Where a random value of a parameter lies, by unit: sizes that occur in a ball screw.
BY_UNIT = {
    "1": (0.1, 0.9),
    "m": (1e-3, 5e-2),
    "rad": (0.1, 1.2),
    "N": (1.0, 1000.0),
    "N m": (1e-3, 10.0),
    "N/m": (1e8, 3e9),
    "m/N": (1e-7, 1e-5),
    "N m/rad": (1.0, 100.0),
    "N/m^1.5": (1e9, 1e11),
    "W": (0.1, 10.0),
    "Pa": (1e9, 3e11),
    "1/Pa": (1e-8, 3e-8),
    "m/s": (0.01, 5.0),
    "J": (1e-5, 1e-2),
    "rad/s": (1.0, 300.0),
    "Pa s": (0.01, 0.5),
    "m^2/s": (1e-6, 5e-4),
    "kg/m^3": (800.0, 950.0),
    "kg": (1e-5, 1e-2),
    "m/s^2": (1.0, 20.0),
    "K": (300.0, 370.0),
    "W/(m K)": (0.1, 50.0),
    "J/(kg K)": (400.0, 2000.0),
    "1/m": (1.0, 1000.0),
    "1/m^2": (1e9, 1e11),
    "1/s": (1e5, 1e7),
    "1/K": (0.01, 0.06),
    "kg m^2": (1e-4, 1e-2),
    "N m s/rad": (1e-4, 1e-2),
}

#: The same by name, where the unit alone does not keep the value in the domain.
BY_NAME = {
    "across": (0.1, 0.6),
    "along": (0.1, 0.6),
    "asperity_pressure": (1e6, 1e9),
    "asperity_radius": (1e-6, 1e-4),
    "combined_roughness": (1e-7, 1e-6),
    "ball_reynolds_number": (1.0, 1000.0),
    "ball_approach": (1e-6, 3e-5),
    "ball_excess": (1e-7, 1e-5),
    "balls_per_turn": (10.0, 60.0),
    "bore": (1e-3, 2e-2),
    "buckling_root": (1.0, 7.0),
    "cell_variance": (1e-3, 0.1),
    "conformity": (0.51, 0.56),
    "ellipticity": (1.0, 15.0),
    "equivalent_modulus": (1e11, 3e11),
    "exponent": (0.5, 1.5),
    "eyring_stress": (2e6, 2e7),
    # so far that the ends of the load shares are seen
    "film_parameter": (0.1, 3.1),
    "film_viscosity": (1.0, 100.0),
    "flank_displacement": (1e-6, 1e-4),
    "groove_centre_distance": (5e-5, 8e-4),
    "high_number": (3.0, 30.0),
    "inlet_film_ratio": (2.0, 200.0),
    "lip_friction": (10.0, 200.0),
    "high_temperature": (370.0, 390.0),
    "low_temperature": (300.0, 320.0),
    "limiting_shear_stress": (1e7, 2e8),
    "line_load_parameter": (1e-5, 1e-3),
    "load_parameter": (1e-6, 1e-3),
    "lower_line": (0.1, 0.4),
    "loaded_balls": (10.0, 200.0),
    "loaded_centre_distance": (5e-5, 8e-4),
    "loaded_turns": (1.0, 6.0),
    "low_number": (40.0, 500.0),
    "material_parameter": (1000.0, 10000.0),
    "maximum_pressure": (5e8, 3e9),
    "oil_gap": (1e-6, 1e-3),
    "mean_pressure": (5e8, 2e9),
    "nut_conformity": (0.51, 0.56),
    # so light that some loads set a half free
    "preload": (10.0, 200.0),
    "outside_diameter": (3e-2, 6e-2),
    "pressure": (1e8, 1.5e9),
    "pressure_modulus_slope": (0.0, 0.04),
    "radii_ratio": (1.0, 60.0),
    "replenishment_constant": (1e-8, 1e-7),
    "roelands_exponent": (0.4, 0.8),
    "screw_conformity": (0.51, 0.56),
    "slide_to_roll_ratio": (1e-3, 1.0),
    "slope_at_zero": (0.0, 0.04),
    "slope_per_degree": (-2e-5, 3e-4),
    # so slow that the least drag of the oil is seen
    "speed": (0.1, 2.0),
    "speed_parameter": (1e-12, 1e-9),
    "traction_ratio": (-0.3, 0.9),
    "unsupported_length": (0.2, 3.0),
    "upper_line": (0.5, 0.9),
    "vogel_constant": (600.0, 1300.0),
    "vogel_temperature": (170.0, 190.0),
    "viscosity_at_infinity": (5e-8, 1e-7),
    "walther_number": (3.0, 500.0),
    "walther_slope": (3.0, 4.0),
    "whirling_root": (1.0, 5.0),
}
#: The same by equation and name: here numbers count that only thin oils see, or films as thick as the asperities.
BY_PLACE = {
    "friction.asperity_contact_integral.film_parameter": (2.0, 4.5),
    "rheology.kinematic_viscosity_of_walther_number.walther_number": (1.3, 2.5),
    "rheology.walther_number.kinematic_viscosity": (3e-7, 1.5e-6),
    "rheology.walther_number_slope.kinematic_viscosity": (3e-7, 1.5e-6),
}


def domain(name: str, unit: str | None) -> tuple[float, float]:
    """Where values of a parameter may lie."""
    return BY_NAME[name] if name in BY_NAME else BY_UNIT[unit]

// Names of results, checks and columns in words, and why a design is not kept.

/** Results. @type {Record<string, string>} */
export const RESULTS = {
  back_driving_efficiency: "efficiency, load drives",
  ball_to_ball_force: "force between balls",
  drive_torque: "drive torque",
  efficiency: "efficiency, screw drives",
  friction_angle: "friction angle ρ of the thread",
  friction_coefficient: "friction coefficient µ of the thread",
  friction_power: "heat",
  holding_torque: "holding torque",
  largest_contact_load: "normal load",
  maximum_pressure: "greatest pressure",
  minimum_film_parameter: "least film parameter λ",
  minimum_film_thickness: "least film thickness",
  preload_drag: "drag torque, with seals where given",
  screw_torque: "friction torque",
};

/** Checks. @type {Record<string, string>} */
const CHECKS = {
  buckling: "buckling",
  contact_pressure: "contact pressure",
  critical_speed: "critical speed",
  diameter_speed_product: "speed of the balls d·n",
  life: "life in revolutions",
  motor_peak_torque: "peak torque of the motor",
  motor_rms_torque: "RMS torque of the motor",
  motor_speed: "speed of the motor",
  running_time: "life in hours",
  shaft_stress: "stress in the shaft",
  static_safety: "static safety S₀",
};

/** A check in words. @param {{ name: string }} check */
export function nameOfCheck({ name }) {
  return CHECKS[name] ?? name.replaceAll("_", " ");
}

/** Columns of a log. @type {Record<string, string>} */
export const COLUMNS = {
  axial_load: "axial load",
  current: "current",
  drive_torque: "drive torque",
  feed_rate: "feed rate",
  friction_torque: "friction torque",
  position: "position",
  screw_speed: "speed of the screw",
  temperature: "temperature",
  time: "time",
  torque: "torque",
};

/** Why nothing is kept in this browser. @type {Record<string, string>} */
export const NOT_KEPT = {
  forbidden: "This browser does not let the page keep anything: save a project before you close it.",
  full: "The storage of this browser is full: the last changes are not kept. Save a project, or delete what is kept.",
};

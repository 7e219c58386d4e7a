// Fields that follow another one, so that an oil, a nut and an installation are never told in two ways, or in half a way.

/** What tells an oil, each on its own. @type {Record<string, string[]>} */
const OILS = {
  viscosity: ["grade", "oil", "kinematic_viscosity_40", "kinematic_viscosity_100", "temperature"],
  grade: ["viscosity", "oil", "kinematic_viscosity_40", "kinematic_viscosity_100"],
  oil: ["viscosity", "grade"],
  kinematic_viscosity_40: ["viscosity", "grade"],
  kinematic_viscosity_100: ["viscosity", "grade"],
};
/** Fields that a data sheet has beside its viscosities. */
const OF_SHEET = ["density_15", "pour_point", "lowest_temperature", "highest_temperature"];
/** Properties that belong to the oil that is replaced. */
const OF_VISCOSITY = ["pressure_viscosity_coefficient", "temperature_coefficient"];
const USUAL_TEMPERATURE = "40 degC";
const USUAL_ENDS = "fixed-supported";

/**
 * Texts of other fields after a field has become this text; an empty one takes the field away.
 *
 * @param {string} path
 * @param {string} text
 * @param {(path: string) => unknown} given what the design gives now
 * @param {Vocabulary["nuts"]} nuts
 * @returns {Record<string, string>}
 */
export function consequences(path, text, given, nuts) {
  const [section, field] = path.split(".");
  /** @param {string[]} names */
  const without = (names) =>
    Object.fromEntries(
      names.map((name) => `${section}.${name}`).flatMap((one) => (given(one) === undefined ? [] : [[one, ""]])),
    );
  if (!text) return {};
  if (section === "lubricant" && Object.hasOwn(OILS, field)) {
    const more = field === "viscosity" || field === "grade" ? OF_SHEET : [];
    const ofOld = given("lubricant.viscosity") !== undefined && field !== "viscosity" ? OF_VISCOSITY : [];
    const found = without([...OILS[field], ...more, ...ofOld]);
    // that which counts where none is given, to be seen
    if (field !== "viscosity" && given("lubricant.temperature") === undefined) {
      found["lubricant.temperature"] = USUAL_TEMPERATURE;
    }
    return found;
  }
  if (path === "nut.type" && Object.hasOwn(nuts, text)) {
    const { fields, usual_preload: usual } = nuts[text];
    const others = Object.values(nuts).flatMap((kind) => kind.fields);
    const found = without([...new Set(others)].filter((name) => !fields.includes(name)));
    const has = (/** @type {string} */ name) => fields.includes(name) && given(`nut.${name}`) !== undefined;
    if (usual && !has("preload") && !has("oversize")) found["nut.preload"] = usual;
    return found;
  }
  if (path === "nut.preload") return without(["oversize"]);
  if (path === "nut.oversize") return without(["preload"]);
  if (path === "installation.unsupported_length" && given("installation.ends") === undefined) {
    return { "installation.ends": USUAL_ENDS };
  }
  return {};
}

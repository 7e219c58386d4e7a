// The JSON Schema of the case file, and the fields of the form that it describes.

/**
 * @typedef {object} SchemaNode
 * @property {string} [type]
 * @property {string} [description]
 * @property {string} [$ref]
 * @property {string[]} [enum]
 * @property {string} [const]
 * @property {string | number | boolean} [default]
 * @property {(string | number)[]} [examples]
 * @property {SchemaNode[]} [anyOf]
 * @property {Record<string, SchemaNode>} [properties]
 * @property {string} [x-si-unit]
 * @property {string} [x-unit]
 * @property {string} [x-symbol]
 * @property {string} [x-hint]
 * @property {string} [x-through-lead] the SI unit of a speed of the nut, which may stand in its place
 */

/** Headings of the sections of the form, in their order. @type {Record<string, string>} */
export const SECTIONS = {
  operation: "Operating point",
  screw: "Screw",
  nut: "Nut",
  lubricant: "Oil",
  model: "Model",
  losses: "Seals and other losses",
  installation: "Installation",
  limits: "Limits",
  bodies: "Elastic bodies",
  deviations: "Balls that differ",
};
/** Headings of the sections that cards have, not the form. @type {Record<string, string>} */
export const OF_CARDS = {
  axis: "Axis",
  motion: "Motion",
  motor: "Motor",
  surroundings: "Surroundings",
  bearings: "Bearings",
  guides: "Guides",
};
/** One of these that the answer follows, too: a rigidity is that of the nut with its bearings. */
const OF_ANSWER = "bearings";
/** Fields that the form does not have. */
export const LEFT_OUT = ["screw.catalogue", "screw.catalogue_file", "lubricant.oil_file"];

/** The document of the server, filled before anything is shown. */
const schema = {
  /** @type {Record<string, SchemaNode>} */
  $defs: {},
  /** @type {Record<string, SchemaNode>} */
  properties: {},
};

/** @param {typeof schema} document */
export function fill(document) {
  Object.assign(schema, document);
}

/**
 * @template Value
 * @param {Record<string, Value> | undefined} table
 * @param {string} name
 * @returns {Value | undefined}
 */
function own(table, name) {
  return table && Object.hasOwn(table, name) ? table[name] : undefined;
}

/**
 * A node with its reference resolved.
 *
 * @param {SchemaNode | undefined} node
 */
export function definition(node) {
  const name = node?.$ref?.split("/").pop();
  return name ? schema.$defs[name] : node;
}

/**
 * The fields of a section.
 *
 * @param {string} name
 * @returns {Record<string, SchemaNode>}
 */
export function fieldsOf(name) {
  const node = own(schema.properties, name);
  return definition(node?.anyOf ? node.anyOf[0] : node)?.properties ?? {};
}

/**
 * The schema of a field of the form by its path, such as ``model.friction.boundary_friction_coefficient``.
 *
 * @param {string} path
 * @returns {SchemaNode | undefined}
 */
export function fieldOf(path) {
  const [name, field, inner, ...others] = path.split(".");
  if (!(own(SECTIONS, name) || own(OF_CARDS, name)) || LEFT_OUT.includes(`${name}.${field}`) || others.length)
    return undefined;
  const node = definition(own(fieldsOf(name), field));
  if (inner === undefined || !node) return node;
  if (node.properties) return definition(own(node.properties, inner));
  return node.anyOf?.map((one) => own(one.properties, inner)).find((one) => one);
}

/**
 * Test whether sections are those of cards, which the answer above does not follow.
 *
 * @param {string[]} sections
 */
export function areOfCards(sections) {
  return sections.every((one) => isOfCards(one));
}

/**
 * A case without the sections that only cards ask about.
 *
 * @param {Record<string, any>} tables
 */
export function withoutCards(tables) {
  return Object.fromEntries(Object.entries(tables).filter(([name]) => !isOfCards(name)));
}

/** @param {string} name */
function isOfCards(name) {
  return name !== OF_ANSWER && own(OF_CARDS, name) !== undefined;
}

/** @param {SchemaNode} node */
export function isLaw(node) {
  return node.anyOf?.some((one) => one.properties?.law) ?? false;
}

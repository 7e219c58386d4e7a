import { Engine } from "./engine.js";
import { keepOffline, moduleOf, site } from "./modules.js";

const { contents } = site();
const engine = new Engine(contents, moduleOf);
const start = contents.starts.paper;
const structure = Object.keys(contents.structures)[0];
engine.load(structure).then(() => {
  const [model, kind] = structure.split("/");
  const values = { ...contents.models[model].values, ...start.values, ...start.nuts[kind].values };
  const outputs = engine.evaluate(structure, values, 1);
  /** @type {any} */ (globalThis).ballscrew = { inputs: values, outputs: { screw_torque: outputs.screw_torque[0] } };
  document.documentElement.dataset.ready = "true";
});
keepOffline();

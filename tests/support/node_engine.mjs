// The engine of the static page in node: the outputs of a structure, or the numbers of an oil, at points of a file,
// written to another one.
import { readFile, writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [engineFile, folder] = process.argv.slice(2);
const { Engine } = await import(pathToFileURL(engineFile));
const { contents, jobs } = JSON.parse(await readFile(`${folder}/jobs.json`, "utf8"));
const engine = new Engine(contents, async (file) => WebAssembly.compile(await readFile(`${folder}/${file}`)));
for (const { structure, grade, count, names, one, out, times = 1 } of jobs) {
  await engine.load(structure);
  const bytes = await readFile(`${folder}/${out}.in`);
  const all = new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
  const values = { ...one };
  names.forEach((name, i) => {
    values[name] = all.subarray(i * count, (i + 1) * count);
  });
  let found = {};
  const milliseconds = [];
  for (let k = 0; k < times; k++) {
    const start = performance.now();
    found = grade ? engine.oil(grade, values.t, count) : engine.evaluate(structure, values, count);
    milliseconds.push(performance.now() - start);
  }
  const arrays = Object.values(found);
  const whole = new Float64Array(arrays.length * count);
  arrays.forEach((array, i) => {
    whole.set(array, i * count);
  });
  await writeFile(`${folder}/${out}.out`, new Uint8Array(whole.buffer));
  await writeFile(`${folder}/${out}.json`, JSON.stringify({ names: Object.keys(found), milliseconds }));
}

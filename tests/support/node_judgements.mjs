// What the page judges and draws at points of a file: values, masks, records and texts, written to another one.
import { readFile, writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [page, folder] = process.argv.slice(2);
const { Engine } = await import(pathToFileURL(`${page}/engine.js`));
const { judgedAt, recordsOf, textOf } = await import(pathToFileURL(`${page}/judgements.js`));
const { ballAt } = await import(pathToFileURL(`${page}/ball_drawing.js`));
const { contents, points } = JSON.parse(await readFile(`${folder}/points.json`, "utf8"));
const engine = new Engine(contents, async (file) => WebAssembly.compile(await readFile(`${folder}/${file}`)));
const written = (found) => Object.fromEntries(Object.entries(found).map(([name, value]) => [name, String(value)]));
const found = [];
for (const point of points) {
  await engine.load(point.structure);
  const judged = judgedAt(engine, contents, point);
  const records = recordsOf(contents, judged);
  for (const one of [...records.verdicts, ...records.warnings, ...records.checks]) {
    one.text = textOf(contents, one.message);
  }
  const { inputs, outputs } = judged.sources;
  const places = ballAt(engine, contents, { structure: point.structure, inputs, outputs });
  found.push({
    found: written(judged.found),
    derived: written(judged.derived),
    outputs: written(outputs),
    known: [...judged.known],
    drawing: written(places),
    records,
  });
}
await writeFile(`${folder}/judged.json`, JSON.stringify(found));

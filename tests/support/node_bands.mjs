// The bands of the page in node: those of cases in a file, and the milliseconds that they took.
import { readFile, writeFile } from "node:fs/promises";
import { pathToFileURL } from "node:url";

const [page, engineFile, folder] = process.argv.slice(2);
const { Engine } = await import(pathToFileURL(engineFile));
const { bandsOf, calibratedOf, makersIn, uncertainIn } = await import(pathToFileURL(`${page}/bands.js`));
const { contents, questions, step } = JSON.parse(await readFile(`${folder}/questions.json`, "utf8"));
const engine = new Engine(contents, async (file) => WebAssembly.compile(await readFile(`${folder}/${file}`)));
await engine.loadFile(contents.bands.file);
const answers = [];
for (const question of questions) {
  await engine.load(question.structure);
  const makers = makersIn(contents.bands, question);
  if (makers.length) await engine.load(calibratedOf(question));
  const began = performance.now();
  const found = { names: uncertainIn(contents.bands, question)?.map(({ name }) => name), makers, steps: 0 };
  for (const kind of ["point", "fan"]) {
    for (const band of bandsOf(engine, contents.bands, { ...question, kind }, step)) {
      if (band) found[kind] = { ...band, milliseconds: performance.now() - began };
      else found.steps += 1;
    }
  }
  answers.push(found);
}
await writeFile(`${folder}/answers.json`, JSON.stringify(answers));

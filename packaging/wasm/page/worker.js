// The worker of elastokin.html, behind wasi.mjs and library.js: compiles the program once, runs command lines, and solves cases of
// a model that it keeps open.
let program, library = null, opened = {}, openings = 0, refused = "";

// Compiles the program while it is unpacked
async function compile(text) {
  const letters = atob(text), packed = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; k++) packed[k] = letters.charCodeAt(k);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(stream, { headers: { "Content-Type": "application/wasm" } }));
}

// files: [path, content] of the document; answers with the result and the files that the command wrote or changed
async function run({ words, files }) {
  const disk = new Disk(), given = new Map(), written = [];
  for (const [path, content] of files) {
    disk.addFile(path, content);
    given.set(path, disk.nodes.get(path).content.slice());
  }
  const result = await runCommand(await program, words, disk);
  for (const [path, content] of disk.files()) {
    const old = given.get(path);
    if (old && old.length === content.length && old.every((byte, k) => byte === content[k])) continue;
    written.push([path, content.slice()]);
  }
  return { ...result, written };
}

// Opens the model unless only numbers differ from the document that was opened last: `frame` is the document without these numbers.
// Answers with the message of an error, or null.
async function openModel({ files, deck, frame, numbers }) {
  library ??= await Library.start(await program);
  if (opened.frame === frame && opened.deck === deck) {
    const status = library.set(numbers, opened.numbers);
    if (status === success) return null;
    if (status !== wrongUse) return library.message();
  }
  opened = {};
  openings++;
  if (library.open(files, deck) !== success) return library.message();
  const cases = library.list("case", ["name", "is_of_deck"]).filter(([, isOfDeck]) => isOfDeck === 1).map(([name]) => name);
  opened = { frame, deck, numbers: new Map(numbers), cases, isNew: true };
  if (opened.numbers.size < numbers.length) opened.frame = null;       // a path with two numbers: each change opens the model
  return null;
}

// Solves a case: { columns: name -> numbers, or null, poses of each row, names of the bodies, status, messages, trap, duration
// [ms], bytes of memory, openings }, and for a model that was opened { units, keyNumbers }. A test that the deck does not have is
// solved by the command line the first time, then in the model with a case of this range (addTest).
async function solve({ solve: asked }) {
  const start = performance.now(), { test, increments, columns } = asked;
  let messages = await openModel(asked), found = null, status = wrongUse, poses = null;
  const lists = opened.isNew ? { units: unitsOf(asked.numbers), keyNumbers: library.list("number", ["name"]).flat() } : {};
  opened.isNew = false;
  if (messages === null && opened.cases.includes(test)) {
    ({ status, columns: found = null, poses } = library.solve(test, increments, columns));
    messages = library.message();
  }
  if (messages === null || !isWhole(test, asked, found)) {
    const result = await solveByCommand(asked);
    if (result.trap) return { ...result, columns: null };
    ({ status, messages, columns: found } = result);
    poses = found && opened.frame ? addTest(asked, found) : null;
  }
  const { bodies, bytes } = library, duration = performance.now() - start;
  return { columns: found, poses, bodies, status, messages, trap: null, duration, bytes, openings, ...lists };
}

async function solveByCommand({ files, deck, test, increments, columns }) {
  const words = ["run", deck, "--case", test, "--increments", String(increments), "--quiet", "--out", "/curves"];
  const result = await run({ words: columns.length > 0 ? [...words, "--columns", columns.join(",")] : words, files });
  return { ...result, columns: result.trap ? null : columnsOf(result.written) };
}

// Ranges of standard tests that end earlier where the axle locks. The range of `steering` is a parameter of the deck
const reaches = { parallel_travel: 80, opposite_travel: 60, roll: 3 };

// Whether a solution in the open model is that of the standard test: an axle that locks inside the range has another range
function isWhole(test, { numbers }, columns) {
  if (opened.added !== test) return true;
  if (test === "steering" && numbers.some(([path, value]) => path === "steering.travel" && value !== opened.numbers.get(path))) return false;
  return !(test in reaches) || columns !== null && columns.converged.every((one) => one === 1);
}

// Opens the model with a case for a standard test whose solution by the command line has these columns. Answers with the poses of this
// solution, or null if the case has other states: a shortened range, or other units.
function addTest({ files, deck, frame, test, numbers, increments, columns }, found) {
  const { factor } = found, ends = [factor[0], factor.at(-1)], { cases } = opened;
  if (opened.added === test || refused === `${test} ${frame}` || test in reaches && ends.some((end) => Math.abs(Math.abs(end) - reaches[test]) > 1e-9)) return null;
  const added = `\n&case test = '${test}', from = ${ends[0]}, to = ${ends[1]} /\n`;
  openings++;
  if (library.open(files.map(([path, text]) => [path, path.replace(/^\//, "") === deck ? text + added : text]), deck) === success) {
    const { columns: again = {}, poses } = library.solve(test, increments, columns);
    if (again.factor?.length === factor.length && factor.every((one, k) => Math.abs(one - again.factor[k]) <= 1e-9 * Math.abs(ends[1]))) {
      opened = { frame, deck, numbers: new Map(numbers), cases: [...cases.filter((name) => name !== opened.added), test], added: test };
      return poses;
    }
  }
  opened = {};
  refused = `${test} ${frame}`;
  return null;
}

// [path, unit] of the numbers that the program lists. On a mirrored axle the program lists each side, with the name of the side. The
// value of an adjuster is listed without its key
function unitsOf(numbers) {
  const listed = new Map(library.list("parameter", ["path", "unit"]));
  const unitOf = (path) => listed.get(path) ?? listed.get(path.replace(".", ".left_"));
  return numbers.map(([path]) => [path, unitOf(path.replace(/^(adjuster\..+)\.value$/, "$1"))]).filter(([, unit]) => unit !== undefined);
}

// The columns of the first table among files
function columnsOf(written) {
  const table = written.find(([path]) => /\.csv$/.test(path)), columns = {};
  if (!table) return null;
  const lines = new TextDecoder().decode(table[1]).split("\n").filter((line) => line !== "" && !line.startsWith("#"));
  const rows = lines.map((line) => line.split(","));
  rows[0].forEach((name, k) => { columns[name] = rows.slice(1).map((row) => row[k] === "" ? NaN : Number(row[k])); });
  return columns;
}

addEventListener("message", async ({ data }) => {
  if (data.program) {
    program = compile(data.program);
    program.then(() => postMessage({ ready: true }), (error) => postMessage({ failure: String(error.message ?? error) }));
    return;
  }
  const answer = await (data.solve ? solve(data) : run(data)).catch((error) => {
    if (data.solve) library = null;       // the instance is lost: the next solution begins in a new one
    opened = {};
    return { status: 70, output: "", messages: "", trap: String(error.message ?? error), written: [], columns: null };
  });
  postMessage({ id: data.id, ...answer }, (answer.written ?? []).map(([, content]) => content.buffer));
});

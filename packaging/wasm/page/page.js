// elastokin.html: a document (deck and the files that it names), the program in a worker, and what the last command wrote.
"use strict";
const element = (id) => document.getElementById(id);
const library = JSON.parse(element("decks").textContent), largest = 20e6;
// The folder with which the page was made (python -m elastokin.workbench): { name, files: [path, text] }, or null
const folder = JSON.parse(element("given-folder").textContent);
const storage = folder ? `elastokin.document ${folder.name}` : "elastokin.document";
const isDeck = (text) => /^\s*&(model|study|fit)\b/im.test(text), isModel = (text) => /^\s*&model\b/im.test(text);

// ---- the program ----------------------------------------------------------------------------------

// Runs command lines in a worker, one after the other. `stop` ends the worker; the next command begins in a new one.
class Program {
  constructor() {
    this.source = URL.createObjectURL(new Blob([element("worker").textContent], { type: "text/javascript" }));
    this.waiting = new Map();
    this.count = 0;
    this.start();
  }

  start() {
    this.worker = new Worker(this.source);
    this.ready = new Promise((resolve, reject) => {
      this.worker.onmessage = ({ data }) => {
        if (data.ready) resolve();
        else if (data.failure) reject(new Error(data.failure));
        else {
          this.waiting.get(data.id)?.(data);
          this.waiting.delete(data.id);
        }
      };
      this.worker.onerror = (event) => reject(new Error(event.message));
    });
    this.ready.catch(() => {});
    this.worker.postMessage({ program: element("program").textContent });
  }

  stop() {
    this.worker.terminate();
    for (const answer of this.waiting.values()) answer(null);
    this.waiting.clear();
    this.start();
  }

  // files: [path, content] pairs; resolves to the result (worker.js), or to null if it was stopped
  run(words, files) { return this.ask({ words, files: onDisk(files) }); }

  // A case solved in the instance that the worker keeps (`solve` of worker.js); null if it was stopped
  solve(asked) { return this.ask({ solve: { ...asked, files: onDisk(asked.files) } }); }

  async ask(question) {
    await this.ready;
    const id = ++this.count;
    return new Promise((resolve) => {
      this.waiting.set(id, resolve);
      this.worker.postMessage({ id, ...question });
    });
  }
}

const absolute = (path) => path.startsWith("/") ? path : `/${path}`;
const onDisk = (list) => list.map(([path, content]) => [absolute(path), content]);
const relative = (path) => path.replace(/^\//, "");

// The words of a command line; quotes keep blanks.
const wordsOf = (line) => [...line.matchAll(/(?:[^\s"']+|"[^"]*"|'[^']*')+/g)]
  .map(([word]) => word.replace(/"([^"]*)"|'([^']*)'/g, "$1$2"));

// ---- the document ---------------------------------------------------------------------------------

const files = new Map();           // path -> text
let deck = "", shown = "", isEdited = false, results = [], remarks = [], busy = false, again = 0;      // remarks: of `check --json`

function fill(select, names, chosen) {
  select.replaceChildren(...names.map((name) => new Option(name, name, false, name === chosen)));
  select.disabled = names.length === 0;
}

function showFile(name) {
  shown = name;
  openText(name, files.get(name) ?? "");
  fill(element("file"), [...files.keys()], shown);
  markText(remarks);
}

// A document replaces the one before, unless it has no deck: tables are added to the document.
function openDocument(list, { name = "", isNew = true } = {}) {
  const decks = list.filter(([path, text]) => /\.nml$/i.test(path) && isDeck(text)).map(([path]) => path);
  if (list.length === 0) return say("No file was opened.", "bad");
  if (decks.length > 0) {
    if (isNew && isEdited && !confirm("The document was edited and will be replaced. Continue?")) return undefined;
    files.clear();
    deck = decks.includes(name) ? name : decks.find((path) => isModel(list.find(([p]) => p === path)[1])) ?? decks[0];
  }
  for (const [path, text] of list) files.set(path, text);
  fill(element("deck"), [...files].filter(([path, text]) => /\.nml$/i.test(path) && isDeck(text)).map(([path]) => path), deck);
  showFile(decks.length > 0 ? deck : list[0][0]);
  isEdited = !isNew;
  keep();
  document.dispatchEvent(new CustomEvent("opened", { detail: { isNew } }));
  return command(["check", deck]);
}

// The document in the storage of the browser, so that a closed page loses nothing
function keep() {
  let isKept = true;
  try {
    localStorage.setItem(storage, JSON.stringify({ files: [...files], deck, isEdited, hasCurves: !element("points").hidden }));
  } catch {      // too large, or no storage: an older document must not come back
    isKept = false;
    try { localStorage.removeItem(storage); } catch { /* no storage */ }
  }
  element("kept").textContent = isKept ? "This browser keeps the document when the page is closed." :
    "This browser does not keep the document: save it before you close the page.";
  element("kept").className = isKept ? "" : "bad";
}

function restore() {
  try {
    const kept = JSON.parse(localStorage.getItem(storage) ?? "null");
    if (!kept || kept.files.length === 0 || folder && !kept.isEdited) return false;       // the folder may have newer files
    if (kept.hasCurves) openTab("points");      // the curves come first, then the check
    openDocument(kept.files, { name: kept.deck, isNew: false });
    isEdited = kept.isEdited;
    return true;
  } catch {
    return false;
  }
}

async function readFiles(list) {
  const read = [], refused = [];
  for (const [path, file] of list) {
    if (file.size > largest) refused.push(`${path} is larger than ${largest / 1e6} MB`);
    else if (/\.(nml|csv|txt|dat|json|tir|bus|spr|dpr|bum|reb|arb|adm|cmd|kin|ipg|xml|tsv)$/i.test(path) || file.size < 1e6) {
      read.push([path, await file.text()]);
    }
  }
  openDocument(read);
  if (refused.length > 0) say(`Not opened: ${refused.join(", ")}.`, "bad");
}

// [path, File] of all that was dropped, with the files of folders
async function dropped(items) {
  const found = [], entries = [];
  for (const item of items) {     // both are asked for at once: the list is emptied when this procedure waits
    const entry = item.webkitGetAsEntry?.(), file = item.getAsFile?.();
    if (entry) entries.push(entry);
    else if (file) found.push([file.name, file]);
  }
  const visit = async (entry, path) => {
    if (entry.isFile) found.push([path, await new Promise((resolve, reject) => { entry.file(resolve, reject); })]);
    else {
      const reader = entry.createReader();
      for (let some; (some = await new Promise((resolve, reject) => { reader.readEntries(resolve, reject); })).length > 0;) {
        for (const child of some) await visit(child, `${path}/${child.name}`);
      }
    }
  };
  for (const entry of entries) await visit(entry, entry.name);
  return found;
}

// ---- commands -------------------------------------------------------------------------------------

const statuses = ["done", "wrong use", "error in the deck", "the model is a mechanism or over-constrained",
  "no convergence in some state", "file error", "stopped before the end"];

function say(text, kind = "") {
  element("status").textContent = text;
  element("status").className = kind;
}

// Runs a command line with the document. While one runs, further ones wait; of checks as one types, only the last.
async function command(words) {
  if (busy) {
    again = words;
    return;
  }
  busy = true;
  again = 0;
  element("command").value = words.map((word) => /[\s"']/.test(word) || word === "" ? `"${word}"` : word).join(" ");
  element("stop").disabled = false;
  say(`${words[0]} …`);
  const start = performance.now();
  try {
    const result = await program.run(words, [...files]);
    if (result === null) say("Stopped. The document is unchanged.");
    else show(words, result, (performance.now() - start) / 1000);
    if (words[0] === "check" && result !== null) await mark(words);
  } catch (error) {
    say(`The program cannot run in this browser: ${error.message}`, "bad");
  }
  busy = false;
  element("stop").disabled = true;
  if (again) command(again);
}

// The messages of a check at their lines in the text
async function mark(words) {
  const before = files.get(shown), result = await program.run([...words, "--json"], [...files]);
  try {
    remarks = JSON.parse(result.output).messages;
  } catch {
    remarks = [];      // a study, or a wrong command
  }
  if (files.get(shown) === before) markText(remarks);
}

function show(words, result, seconds) {
  const pictures = /gnuplot is not installed/.test(result.messages) ? " Pictures by gnuplot are left out." : "";
  if (result.trap) {
    say(`The program was stopped by an error in it: ${result.trap}. The document is unchanged; please report this deck.`, "bad");
  } else {
    const outcome = statuses[result.status] ?? `status ${result.status}`;
    say(`${words[0]}: ${outcome} (${seconds.toFixed(2)} s).${pictures}`, result.status ? "bad" : "good");
  }
  showMessages(result);
  if (words[0] === "check") return;
  results = result.written.map(([path, content]) => [relative(path), content]);
  const page = results.find(([path]) => /\.html$/.test(path));
  fill(element("written"), results.map(([path]) => path), results.find(([path]) => /\.csv$/.test(path))?.[0]);
  showTable();
  showPage(page);
  if (page) openTab("page");
  else if (results.length > 0 && result.status === 0) openTab("tables");
  else openTab("messages");
}

// Messages, then output; a message with a line of a file of the document leads there
function showMessages({ messages, output }) {
  const parts = [];
  for (const [text, isMessage] of [[messages, true], [output, false]]) {
    const block = document.createElement("pre");
    for (const line of text.split("\n")) {
      const span = document.createElement("span"), place = /^(?:\w+: )?(.+?):(\d+): /.exec(line);
      if (isMessage && /\berror\b|^\S+:\d+: /.test(line) && !/^(warning|note|remark)/.test(line)) span.className = "error";
      else if (/^(warning|note|remark)/.test(line)) span.className = "warning";
      if (place && files.has(place[1])) {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = line;
        button.addEventListener("click", () => goTo(place[1], Number(place[2])));
        span.append(button);
      } else span.append(line);
      block.append(span, "\n");
    }
    if (text.trim() !== "") parts.push(block);
  }
  element("messages").replaceChildren(...parts);
}

function goTo(name, line) {
  if (name !== shown) showFile(name);
  goToLine(line);
}

const textOf = (content) => new TextDecoder().decode(content);

// The first 500 rows of a table; any other file as text
function showTable() {
  const name = element("written").value, content = results.find(([path]) => path === name)?.[1], box = element("table");
  element("download").disabled = content === undefined;
  if (content === undefined) return box.replaceChildren("The last command wrote no file.");
  if (!/\.csv$/.test(name)) {
    const block = document.createElement("pre");
    block.textContent = textOf(content).slice(0, 100000);
    return box.replaceChildren(block);
  }
  const rows = textOf(content).split("\n").filter((row) => row !== "" && !row.startsWith("#")).map(cellsOf);
  const table = document.createElement("table");
  rows.slice(0, 501).forEach((cells, k) => {
    const row = table.insertRow();
    for (const cell of cells) {
      const box = document.createElement(k === 0 ? "th" : "td");
      box.textContent = cell;
      row.append(box);
    }
  });
  return box.replaceChildren(table, rows.length > 501 ? `… ${rows.length - 501} further rows are in the file.` : "");
}

const cellsOf = (row) => [...row.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)].slice(0, row.endsWith(",") ? undefined : -1)
  .map(([, cell]) => cell.startsWith('"') ? cell.slice(1, -1).replaceAll('""', '"') : cell);

// The page of a report has scripts of its own: they run in a frame without access to this page
function showPage(page) {
  const box = element("page");
  if (!page) return box.replaceChildren("The last command made no page.");
  const frame = document.createElement("iframe");
  frame.title = "Report page";
  frame.sandbox = "allow-scripts allow-downloads";
  frame.srcdoc = textOf(page[1]);
  const save = document.createElement("button");
  Object.assign(save, { type: "button", id: "save-page", textContent: "Save page" });
  save.addEventListener("click", () => download(...page));
  return box.replaceChildren(save, frame);
}

function openTab(name) {
  for (const tab of document.querySelectorAll("[role=tab]")) {
    tab.setAttribute("aria-selected", String(tab.dataset.tab === name));
    element(tab.dataset.tab).hidden = tab.dataset.tab !== name;
  }
  document.body.classList.toggle("bench", name === "points");
}

function download(name, content) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = name.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// ---- controls -------------------------------------------------------------------------------------

const missing = ["WebAssembly", "DecompressionStream", "Worker"].filter((name) => !globalThis[name]);
let program;

element("library").append(...library.map(({ name, title }) => new Option(title === "" ? name : `${name}: ${title}`, name)));
element("library").addEventListener("change", ({ target }) => {
  const chosen = library.find(({ name }) => name === target.value);
  target.value = "";
  if (chosen) openDocument(chosen.files, { name: chosen.deck });
});
// Kinds of decks that `elastokin new` prints, each with its words
async function listKinds() {
  const { output } = await program.run(["new"], []) ?? { output: "" };
  const kinds = [...output.matchAll(/^(\w+) +(.+)$/gm)];
  element("new").append(...kinds.map(([, kind, words]) => new Option(`${kind}: ${words}`, kind)));
}
element("new").addEventListener("change", async ({ target }) => {
  const kind = target.value, result = await program.run(["new", kind], []);
  target.value = "";
  if (result?.status === 0) openDocument([[`${kind}.nml`, result.output]], { name: `${kind}.nml` });
  else say(`There is no new deck: ${result?.messages ?? "stopped"}`, "bad");
});
element("open").addEventListener("click", () => element("files").click());
element("open-folder").addEventListener("click", () => element("folder").click());
element("files").addEventListener("change", ({ target }) => readFiles([...target.files].map((file) => [file.name, file])));
element("folder").addEventListener("change", ({ target }) => {
  readFiles([...target.files].map((file) => [file.webkitRelativePath, file]));
});
element("deck").addEventListener("change", ({ target }) => {
  deck = target.value;
  showFile(deck);
  document.dispatchEvent(new CustomEvent("opened", { detail: { isNew: true } }));
  command(["check", deck]);
});
element("file").addEventListener("change", ({ target }) => showFile(target.value));
element("save").addEventListener("click", () => {
  if (!files.has(shown)) return;
  download(shown, files.get(shown));
  isEdited = false;
  keep();
});
let pause;
// also the last letters before the page is closed
addEventListener("pagehide", () => { if (files.size > 0) keep(); });

function textEdited(text) {
  if (!files.has(shown)) {
    shown = deck = "deck.nml";
    fill(element("deck"), [deck], deck);
    fill(element("file"), [deck], deck);
  }
  files.set(shown, text);
  isEdited = true;
  document.dispatchEvent(new Event("edited"));
  clearTimeout(pause);
  pause = setTimeout(() => {
    keep();
    command(["check", deck]);
  }, 400);
}
for (const button of document.querySelectorAll("[data-command]")) {
  button.addEventListener("click", () => {
    clearTimeout(pause);
    if (button.dataset.command === "check") openTab("messages");
    command([button.dataset.command, deck, ...(button.dataset.command === "check" ? [] : ["--out", "out"])]);
  });
}
element("line").addEventListener("submit", (event) => {
  event.preventDefault();
  openTab("messages");
  command(wordsOf(element("command").value.replace(/^\s*elastokin\s+/, "")));
});
element("stop").addEventListener("click", () => program.stop());
for (const tab of document.querySelectorAll("[role=tab]")) tab.addEventListener("click", () => openTab(tab.dataset.tab));
element("written").addEventListener("change", showTable);
element("download").addEventListener("click", () => {
  const found = results.find(([path]) => path === element("written").value);
  if (found) download(...found);
});
addEventListener("dragover", (event) => {
  event.preventDefault();
  document.body.classList.add("dropping");
});
addEventListener("dragleave", () => document.body.classList.remove("dropping"));
addEventListener("drop", async (event) => {
  event.preventDefault();
  document.body.classList.remove("dropping");
  readFiles(await dropped(event.dataTransfer.items));
});

// For scripts: a command line with files, path -> text; the files that it wrote as text
globalThis.elastokin = {
  async command(words, given) {
    const { written, ...result } = await program.run(words, Object.entries(given));
    return { ...result, files: Object.fromEntries(written.map(([path, content]) => [relative(path), textOf(content)])) };
  },
};

// node run.mjs PROGRAM.wasm FOLDER WORD...: runs a command of elastokin.wasm as it runs in the page, with page/wasi.mjs.
// node run.mjs PROGRAM.wasm FOLDER --list COMMANDS.json RESULTS.json: many commands, a list of lists of words; the results are a
// list of { status, output, messages, trap }.
//
// The files of FOLDER up to 64 MB are copied to memory, where FOLDER is the working folder `/`. Files that a command writes,
// changes or removes are written, changed or removed in FOLDER. Standard output, standard error and status are those of the
// command; status 70 if WebAssembly stopped the program. Of the environment, only SOURCE_DATE_EPOCH and EK_TEST are passed on.
import fs from "node:fs";
import path from "node:path";
import { Disk, runCommand } from "./page/wasi.mjs";

const [program, folder, ...words] = process.argv.slice(2);
const disk = new Disk(), before = new Map(), largest = 64e6;

function read(from, to) {
  for (const entry of fs.readdirSync(from)) {
    const source = path.join(from, entry), target = `${to}${entry}`, facts = fs.statSync(source, { throwIfNoEntry: false });
    if (facts?.isDirectory()) {
      disk.addFolder(target);
      read(source, `${target}/`);
    } else if (facts?.isFile() && facts.size <= largest) {
      const content = fs.readFileSync(source);
      before.set(target, content);
      disk.addFile(target, new Uint8Array(content));
    }
  }
}

function write() {
  for (const [name, content] of disk.files()) {
    if (before.get(name)?.equals(content)) continue;
    const target = path.join(folder, name);
    fs.mkdirSync(path.dirname(target), { recursive: true });
    fs.writeFileSync(target, content);
  }
  for (const name of before.keys()) if (!disk.kind(name)) fs.rmSync(path.join(folder, name));
}

read(folder, "/");
const passed = ["SOURCE_DATE_EPOCH", "EK_TEST"].filter((name) => process.env[name]);
const environment = Object.fromEntries(passed.map((name) => [name, process.env[name]]));
const module = await WebAssembly.compile(fs.readFileSync(program));
if (words[0] === "--list") {
  const results = [];
  for (const line of JSON.parse(fs.readFileSync(words[1], "utf8"))) results.push(await runCommand(module, line, disk, environment));
  fs.writeFileSync(words[2], JSON.stringify(results));
} else {
  const result = await runCommand(module, words, disk, environment);
  process.stdout.write(result.output);
  process.stderr.write(result.messages);
  if (result.trap) process.stderr.write(`WebAssembly stopped the program: ${result.trap}\n`);
  process.exitCode = result.status;
}
write();

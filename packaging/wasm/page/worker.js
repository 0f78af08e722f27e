// The worker of elastokin.html, behind wasi.mjs: compiles the program once and runs command lines, one after the other.
let program;

async function unpack(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
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

addEventListener("message", async ({ data }) => {
  if (data.program) {
    program = unpack(data.program).then((bytes) => WebAssembly.compile(bytes));
    program.then(() => postMessage({ ready: true }), (error) => postMessage({ failure: String(error.message ?? error) }));
    return;
  }
  const answer = await run(data).catch((error) => {
    return { status: 70, output: "", messages: "", trap: String(error.message ?? error), written: [] };
  });
  postMessage({ id: data.id, ...answer }, answer.written.map(([, content]) => content.buffer));
});

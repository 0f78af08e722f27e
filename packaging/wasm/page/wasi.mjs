// The system of elastokin.wasm: WASI preview 1 with files in memory, one process and no network. The page and run.mjs use it.
//
// `new Disk()` holds files by absolute path; `runCommand` runs one command line in a fresh instance of the compiled program. What
// is missing here answers with the error "not supported", so the program reports it in its own messages.

const errors = {
  badFile: 8, exists: 20, invalid: 28, isFolder: 31, notFound: 44, notSupported: 52, notFolder: 54, notEmpty: 55, noSeek: 70,
};
const kinds = { device: 2, folder: 3, file: 4 };
const utf8 = new TextEncoder();

// A file: its bytes with room behind them, so that appending does not copy the file each time.
class FileNode {
  constructor(content = new Uint8Array()) {
    this.room = content;
    this.length = content.length;
    this.time = Date.now();
  }

  get content() { return this.room.subarray(0, this.length); }

  resize(length) {
    if (length > this.room.length) {
      const wider = new Uint8Array(Math.max(length, 2 * this.room.length, 4096));
      wider.set(this.content);
      this.room = wider;
    }
    if (length > this.length) this.room.fill(0, this.length, length);
    this.length = length;
    this.time = Date.now();
  }

  write(bytes, at) {
    if (at + bytes.length > this.length) this.resize(at + bytes.length);
    this.room.set(bytes, at);
    this.time = Date.now();
  }
}

// Files and folders by absolute path.
export class Disk {
  constructor() {
    this.nodes = new Map([["/", { time: Date.now(), entries: new Set() }]]);     // a folder has `entries`
    this.inodes = new WeakMap();
    this.count = 0;
    this.addFolder("/tmp");
  }

  static clean(path, base = "/") {
    const parts = [];
    for (const part of (path.startsWith("/") ? path : `${base}/${path}`).split("/")) {
      if (part === "..") parts.pop();
      else if (part !== "" && part !== ".") parts.push(part);
    }
    return `/${parts.join("/")}`;
  }

  static split(path) {
    const at = path.lastIndexOf("/");
    return [path.slice(0, at) || "/", path.slice(at + 1)];
  }

  kind(path) {
    const node = this.nodes.get(path);
    return node === undefined ? 0 : node.entries ? kinds.folder : kinds.file;
  }

  inode(node) {
    if (!this.inodes.has(node)) this.inodes.set(node, BigInt(++this.count));
    return this.inodes.get(node);
  }

  place(path, node) {
    const [folder, name] = Disk.split(path);
    this.nodes.set(path, node);
    this.nodes.get(folder).entries.add(name);
    return node;
  }

  take(path) {
    const [folder, name] = Disk.split(path), node = this.nodes.get(path);
    this.nodes.delete(path);
    this.nodes.get(folder).entries.delete(name);
    return node;
  }

  addFolder(path) {
    if (this.nodes.has(path)) return;
    this.addFolder(Disk.split(path)[0]);
    this.place(path, { time: Date.now(), entries: new Set() });
  }

  // content: a string or bytes
  addFile(path, content) {
    this.addFolder(Disk.split(path)[0]);
    this.place(path, new FileNode(typeof content === "string" ? utf8.encode(content) : content));
  }

  // [path, bytes] of every file
  * files() {
    for (const [path, node] of this.nodes) if (!node.entries) yield [path, node.content];
  }
}

// The end of the program, which WASI requests.
class Exit extends Error {
  constructor(status) {
    super(`exit ${status}`);
    this.status = status;
  }
}

// The functions that the program imports. `say(stream, bytes)` receives standard output (1) and standard error (2).
function systemOf(disk, words, environment, say) {
  const files = new Map([0, 1, 2].map((number) => [number, { kind: kinds.device, stream: number }]));
  files.set(3, { kind: kinds.folder, path: "/" });
  let memory, last = 3;
  const data = () => new DataView(memory.buffer), bytes = (at, length) => new Uint8Array(memory.buffer, at, length);
  const utf8Text = new TextDecoder();
  const path = (file, at, length) => Disk.clean(utf8Text.decode(bytes(at, length).slice()), files.get(file)?.path ?? "/");
  const time = (milliseconds) => BigInt(Math.round(milliseconds)) * 1000000n;

  const writeStrings = (list, addresses, at) => {
    for (const text of list) {
      const encoded = utf8.encode(`${text}\0`);
      data().setUint32(addresses, at, true);
      bytes(at, encoded.length).set(encoded);
      addresses += 4;
      at += encoded.length;
    }
    return 0;
  };
  const writeSizes = (list, count, size) => {
    data().setUint32(count, list.length, true);
    data().setUint32(size, list.reduce((sum, text) => sum + utf8.encode(text).length + 1, 0), true);
    return 0;
  };
  const writeFacts = (node, kind, at) => {
    bytes(at, 64).fill(0);
    data().setBigUint64(at, 1n, true);
    data().setUint8(at + 16, kind);
    data().setBigUint64(at + 24, 1n, true);
    if (!node) return 0;
    data().setBigUint64(at + 8, disk.inode(node), true);
    data().setBigUint64(at + 32, BigInt(node.length ?? 0), true);
    for (const offset of [40, 48, 56]) data().setBigUint64(at + offset, time(node.time), true);
    return 0;
  };
  const addFile = (file, result) => {
    files.set(++last, file);
    data().setUint32(result, last, true);
    return 0;
  };
  // the parts of memory that one call reads or writes
  const parts = function* (list, count) {
    for (let k = 0; k < count; k++) yield bytes(data().getUint32(list + 8 * k, true), data().getUint32(list + 8 * k + 4, true));
  };
  const variables = Object.entries(environment).map(([name, value]) => `${name}=${value}`);

  const system = {
    args_get: (addresses, at) => writeStrings(words, addresses, at),
    args_sizes_get: (count, size) => writeSizes(words, count, size),
    environ_get: (addresses, at) => writeStrings(variables, addresses, at),
    environ_sizes_get: (count, size) => writeSizes(variables, count, size),
    clock_time_get(clock, precision, at) {
      data().setBigUint64(at, clock === 0 ? time(Date.now()) : BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    random_get(at, length) {
      for (let k = 0; k < length; k += 65536) crypto.getRandomValues(bytes(at + k, Math.min(65536, length - k)));
      return 0;
    },
    // waits for nothing: the clock has passed at once
    poll_oneoff(wanted, events, count, result) {
      for (let k = 0; k < count; k++) {
        bytes(events + 32 * k, 32).fill(0);
        data().setBigUint64(events + 32 * k, data().getBigUint64(wanted + 48 * k, true), true);
        data().setUint8(events + 32 * k + 10, data().getUint8(wanted + 48 * k + 8));
      }
      data().setUint32(result, count, true);
      return 0;
    },
    proc_exit(status) { throw new Exit(status); },

    fd_close: (number) => files.delete(number) ? 0 : errors.badFile,
    fd_sync: () => 0,
    fd_fdstat_set_flags: () => 0,
    fd_fdstat_get(number, at) {
      const file = files.get(number);
      if (!file) return errors.badFile;
      bytes(at, 24).fill(0);
      data().setUint8(at, file.kind);
      data().setBigUint64(at + 8, 0xffffffffn, true);
      data().setBigUint64(at + 16, 0xffffffffn, true);
      return 0;
    },
    fd_filestat_get(number, at) {
      const file = files.get(number);
      if (!file) return errors.badFile;
      return writeFacts(file.kind === kinds.folder ? disk.nodes.get(file.path) : file.node, file.kind, at);
    },
    fd_filestat_set_size(number, length) {
      const file = files.get(number);
      if (file?.kind !== kinds.file) return file ? errors.invalid : errors.badFile;
      file.node.resize(Number(length));
      return 0;
    },
    fd_prestat_get(number, at) {
      if (number !== 3) return errors.badFile;
      data().setUint32(at, 0, true);
      data().setUint32(at + 4, 1, true);
      return 0;
    },
    fd_prestat_dir_name(number, at, length) {
      bytes(at, length)[0] = "/".charCodeAt(0);
      return 0;
    },
    fd_read(number, list, count, result) {
      const file = files.get(number);
      if (!file) return errors.badFile;
      if (file.kind === kinds.folder) return errors.isFolder;
      let total = 0;
      if (file.kind === kinds.file) {
        for (const part of parts(list, count)) {
          const found = file.node.content.subarray(file.at, file.at + part.length);
          part.set(found);
          file.at += found.length;
          total += found.length;
        }
      }
      data().setUint32(result, total, true);
      return 0;
    },
    fd_write(number, list, count, result) {
      const file = files.get(number);
      let total = 0;
      if (!file || file.kind === kinds.folder) return errors.badFile;
      for (const part of parts(list, count)) {
        if (file.kind === kinds.file) {
          if (file.isAppended) file.at = file.node.length;
          file.node.write(part, file.at);
          file.at += part.length;
        } else if (file.stream) say(file.stream, part.slice());
        total += part.length;
      }
      data().setUint32(result, total, true);
      return 0;
    },
    fd_seek(number, offset, from, result) {
      const file = files.get(number);
      if (!file) return errors.badFile;
      if (file.kind !== kinds.file) return errors.noSeek;
      const at = Number(offset) + [0, file.at, file.node.length][from];
      if (at < 0) return errors.invalid;
      file.at = at;
      data().setBigUint64(result, BigInt(at), true);
      return 0;
    },
    fd_readdir(number, at, size, first, result) {
      const folder = files.get(number);
      if (folder?.kind !== kinds.folder) return errors.badFile;
      const end = at + size, names = [...disk.nodes.get(folder.path).entries];
      let used = at;
      for (let k = Number(first); k < names.length && used < end; k++) {
        const child = Disk.clean(names[k], folder.path), name = utf8.encode(names[k]), entry = new Uint8Array(24 + name.length);
        const view = new DataView(entry.buffer);
        view.setBigUint64(0, BigInt(k + 1), true);
        view.setBigUint64(8, disk.inode(disk.nodes.get(child)), true);
        view.setUint32(16, name.length, true);
        view.setUint8(20, disk.kind(child));
        entry.set(name, 24);
        const part = entry.subarray(0, end - used);
        bytes(used, part.length).set(part);
        used += part.length;
      }
      data().setUint32(result, used - at, true);
      return 0;
    },

    path_open(base, follow, at, length, how, rights, inherited, flags, result) {
      const name = path(base, at, length), kind = disk.kind(name);
      const may = { create: how & 1, folder: how & 2, exclusive: how & 4, truncate: how & 8 };
      if (name === "/dev/null") return addFile({ kind: kinds.device, stream: 0 }, result);
      if (kind && may.exclusive) return errors.exists;
      if (may.folder && kind !== kinds.folder) return kind ? errors.notFolder : errors.notFound;
      if (kind === kinds.folder) return rights & 64n && !may.folder ? errors.isFolder : addFile({ kind, path: name }, result);
      const parent = Disk.split(name)[0];
      if (!kind && (!may.create || disk.kind(parent) !== kinds.folder)) {
        return disk.kind(parent) === kinds.file ? errors.notFolder : errors.notFound;
      }
      const node = kind ? disk.nodes.get(name) : disk.place(name, new FileNode());
      if (kind && may.truncate) node.resize(0);
      return addFile({ kind: kinds.file, node, at: 0, isAppended: Boolean(flags & 1) }, result);
    },
    path_filestat_get(base, follow, at, length, result) {
      const name = path(base, at, length), kind = disk.kind(name);
      if (name === "/dev/null") return writeFacts(null, kinds.device, result);
      return kind ? writeFacts(disk.nodes.get(name), kind, result) : errors.notFound;
    },
    path_create_directory(base, at, length) {
      const name = path(base, at, length), parent = disk.kind(Disk.split(name)[0]);
      if (disk.kind(name)) return errors.exists;
      if (parent !== kinds.folder) return parent ? errors.notFolder : errors.notFound;
      disk.addFolder(name);
      return 0;
    },
    path_remove_directory(base, at, length) {
      const name = path(base, at, length), node = disk.nodes.get(name);
      if (!node?.entries) return node ? errors.notFolder : errors.notFound;
      if (node.entries.size > 0) return errors.notEmpty;
      disk.take(name);
      return 0;
    },
    path_unlink_file(base, at, length) {
      const name = path(base, at, length), kind = disk.kind(name);
      if (kind !== kinds.file) return kind ? errors.isFolder : errors.notFound;
      disk.take(name);
      return 0;
    },
    path_rename(base, at, length, otherBase, otherAt, otherLength) {
      const from = path(base, at, length), to = path(otherBase, otherAt, otherLength);
      const kind = disk.kind(from), there = disk.kind(to);
      if (!kind || !disk.kind(Disk.split(to)[0])) return errors.notFound;
      if (kind === kinds.folder) return errors.notSupported;
      if (there === kinds.folder) return errors.isFolder;
      if (from !== to) disk.place(to, disk.take(from));
      return 0;
    },
    path_readlink(base, at, length) { return disk.kind(path(base, at, length)) ? errors.invalid : errors.notFound; },
    path_symlink: () => errors.notSupported,
  };
  return { system, attach(instance) { memory = instance.exports.memory; } };
}

// An instance of the compiled program with the files of `disk`. `say(stream, bytes)` receives what it prints.
export async function makeInstance(module, words, disk, environment, say) {
  const { system, attach } = systemOf(disk, ["elastokin", ...words], { PWD: "/", ...environment }, say), imported = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (imported[from] ??= {})[name] = system[name] ?? (() => errors.notSupported);
  }
  const instance = await WebAssembly.instantiate(module, imported);
  attach(instance);
  return instance.exports;
}

// Runs one command line: resolves to { status, output, messages, trap }. The files are those of `disk`, before and after. `trap`
// is null, or the reason why WebAssembly stopped the program; then status is 70.
export async function runCommand(module, words, disk, environment = {}) {
  const streams = ["", "", ""], decoders = [0, 1, 2].map(() => new TextDecoder());
  let status = 0, trap = null;
  try {
    const program = await makeInstance(module, words, disk, environment,
      (stream, part) => { streams[stream] += decoders[stream].decode(part, { stream: true }); });
    program._start();
  } catch (error) {
    if (error instanceof Exit) status = error.status;
    else {
      status = 70;
      trap = String(error.message ?? error);
    }
  }
  return { status, output: streams[1], messages: streams[2], trap };
}

// The functions of elastokin.h in one instance of the program, behind wasi.mjs: a model is opened once, and solved anew after its
// numbers have changed. An address in a list has 8 bytes there, and a function with strings has further arguments that are not used.
const success = 0, wrongUse = 1, partly = 4;      // EK_OK, EK_USAGE, EK_CONVERGENCE

class Library {
  static async start(module) {
    const library = new Library();
    library.disk = new Disk();
    library.program = await makeInstance(module, [], library.disk, {}, () => {});
    library.program.ek_initialize();
    library.model = 0;
    return library;
  }

  get bytes() { return this.program.memory.buffer.byteLength; }

  // Calls a function of elastokin.h. Strings, lists of strings and room for results (`room`) are in memory during the call.
  call(name, ...words) {
    const places = [], call = this.program[name];
    const take = (size) => {
      places.push(this.program.malloc(Math.max(size, 1)));
      return places.at(-1);
    };
    const place = (word) => {
      if (typeof word === "string") {
        const letters = utf8.encode(`${word}\0`), at = take(letters.length);
        new Uint8Array(this.program.memory.buffer).set(letters, at);
        return at;
      }
      if (Array.isArray(word)) {
        const list = word.map(place), at = take(8 * list.length), view = new DataView(this.program.memory.buffer);
        list.forEach((one, k) => view.setBigUint64(at + 8 * k, BigInt(one), true));
        return at;
      }
      if (word instanceof Float64Array) {
        word.place = take(word.byteLength);
        new Uint8Array(this.program.memory.buffer, word.place, word.byteLength).fill(0);
        return word.place;
      }
      return word;
    };
    const given = words.map(place);
    while (given.length < call.length) given.push(0n);
    const answer = call(...given);
    for (const word of words) {
      if (!(word instanceof Float64Array)) continue;
      word.set(new Float64Array(this.program.memory.buffer.slice(word.place, word.place + word.byteLength)));
    }
    for (const at of places) this.program.free(at);
    return answer;
  }

  // The result of a function that returns a string
  text(name, ...words) {
    const at = this.call(name, this.model, ...words), memory = new Uint8Array(this.program.memory.buffer);
    return at === 0 ? "" : new TextDecoder().decode(memory.slice(at, memory.indexOf(0, at)));
  }

  message() { return this.text("ek_message"); }

  // files: [path, text]
  open(files, deck) {
    if (this.model !== 0) this.call("ek_close", this.model);
    for (const [path] of [...this.disk.files()]) this.disk.take(path);
    for (const [path, text] of files) this.disk.addFile(path, text);
    const handle = new Float64Array(1), status = this.call("ek_open_file", deck, handle);
    this.model = new Uint32Array(handle.buffer)[0];
    this.bodies = status === success ? this.list("body", ["name"]).flat() : [];
    this.known = new Map();       // path -> number, of paths that were set
    this.prepared = new Map();    // case -> its number of increments
    return status;
  }

  // A list of the model by its functions `ek_<noun>_count` and those in `facts`
  list(noun, facts) {
    return Array.from({ length: this.call(`ek_${noun}_count`, this.model) }, (_, k) => facts.map((fact) => /^is_/.test(fact) ?
      this.call(`ek_${noun}_${fact}`, this.model, k) : this.text(`ek_${noun}_${fact}`, k)));
  }

  // Sets numbers, [path, value], of which `opened` has the values at opening. `wrongUse` if a path does not lead to this number.
  set(numbers, opened) {
    for (const [path, value] of numbers) {
      const known = this.known.get(path) ?? opened.get(path);
      if (value === known) continue;
      if (!this.known.has(path)) {
        const found = new Float64Array(1), status = this.call("ek_get", this.model, path, found);
        if (status !== success || !(Math.abs(found[0] - known) <= 1e-12 * Math.abs(known))) return wrongUse;
      }
      const status = this.call("ek_set", this.model, path, value);
      if (status !== success) return status;
      this.known.set(path, value);
    }
    return success;
  }

  // { status, columns: name -> numbers, poses of each row }; no columns without a solution. `wanted` empty: all
  solve(test, increments, wanted) {
    if (this.prepared.get(test) !== increments) {
      const status = this.call("ek_set_text", this.model, `case.${test}.increments`, String(increments));
      if (status !== success) return { status };
      this.prepared.set(test, increments);
    }
    const status = this.call("ek_solve", this.model, test, wanted.length, wanted.length > 0 ? wanted : 0);
    const rows = status === success || status === partly ? this.call("ek_row_count", this.model) : 0;
    if (rows === 0) return { status };
    const heads = this.list("column", ["name"]).flat(), values = new Float64Array(rows * heads.length), columns = {};
    this.call("ek_values", this.model, values.length, values);
    heads.forEach((head, k) => { columns[head] = Array.from({ length: rows }, (_, row) => values[row * heads.length + k]); });
    return { status, columns, poses: Array.from({ length: rows }, (_, row) => this.poses(row)) };
  }
  // The motion of the bodies from design to a state of the solution, 12 numbers each (ek_poses)
  poses(row) {
    const values = new Float64Array(12 * this.bodies.length);
    this.call("ek_poses", this.model, row, values.length, values);
    return values;
  }
}

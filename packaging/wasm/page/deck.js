// The parameters of a deck in its text, for workbench.js: points, and the numbers of other groups by the path that --set uses.

// A text of the same length in which strings are ×, comments blank
function maskOf(text) {
  let masked = "", quote = "";
  for (let k = 0; k < text.length; k++) {
    const c = text[k];
    if (quote) {
      masked += c === quote ? c : c === "\n" ? c : "×";
      if (c === quote || c === "\n") quote = "";
    } else if (c === "!") {
      const end = text.indexOf("\n", k), stop = end < 0 ? text.length : end;
      masked += " ".repeat(stop - k);
      k = stop - 1;
    } else {
      if (c === "'" || c === '"') quote = c;
      masked += c;
    }
  }
  return masked;
}

// The groups of a deck: { name, keys: key -> { start, end, numbers } }, positions in the text
function groupsOf(text) {
  const masked = maskOf(text);
  return [...masked.matchAll(/^[ \t]*&(\w+)([^/]*)\//gm)].map((found) => {
    const start = found.index + found[0].length - found[2].length - 1, keys = {};
    const heads = [...found[2].matchAll(/([a-z_]\w*)[ \t]*=/gi)];
    heads.forEach((head, k) => {
      const from = start + head.index + head[0].length, end = start + (k + 1 < heads.length ? heads[k + 1].index : found[2].length);
      keys[head[1].toLowerCase()] = { start: from, end, numbers: numbersIn(masked.slice(from, end), from) };
    });
    return { name: found[1].toLowerCase(), keys };
  });
}

const stringsOf = (text, key) => key === undefined ? [] :
  [...text.slice(key.start, key.end).matchAll(/'((?:[^']|'')*)'|"([^"]*)"/g)].map((m) => m[1] ?? m[2]);

// The numbers of a key: { start, text, value }; none beside strings, or if one stands for several (3*0.0)
function numbersIn(part, start) {
  if (/[*×'"]/.test(part)) return [];
  return [...part.matchAll(/[-+]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?/gi)]
    .map((m) => ({ start: start + m.index, text: m[0], value: Number(m[0].replace(/d/i, "e")) }));
}

// The deck and the files that it includes, of the files of a document
function filesOfDeck(given) {
  const found = [], add = (file) => {
    if (found.includes(file) || !given.has(file)) return;
    found.push(file);
    const text = given.get(file);
    for (const { name, keys } of groupsOf(text)) {
      if (name === "include" && keys.file) add(pathFrom(file, stringsOf(text, keys.file)[0] ?? ""));
    }
  };
  add(deck);
  return found;
}

// A path that a file gives relative to its own folder
function pathFrom(file, path) {
  const parts = file.split("/").slice(0, -1);
  for (const part of path.split("/")) {
    if (part === "..") parts.pop();
    else if (part !== ".") parts.push(part);
  }
  return parts.join("/");
}

const single = ["axle", "steering"];      // groups without a name in a path
const unlisted = ["point", "case", "model", "include", "hardpoints", "target_band"];

// Reads a document: { points, rows, links, isMirrored, axes, length: unit in m }. A point is { name, at: three numbers, body }, a row
// { path, numbers } another key with numbers; every number is { path, file, start, text, value }. A link is { ends: two points, kind:
// group, or "body" for points of one body, bodies of the ends }.
function readDocument(given) {
  const points = [], rows = [], of = new Map(), pairs = [];
  let axes = "x-rear", length = 0.001, isMirrored = false;
  const add = (body, point) => {
    if (!body || body === "chassis" || !point) return;
    if (!of.has(body)) of.set(body, new Set());
    of.get(body).add(point);
  };
  for (const file of filesOfDeck(given)) {
    const text = given.get(file);
    for (const { name: group, keys } of groupsOf(text)) {
      const name = stringsOf(text, keys.name)[0];
      if (group === "point" && keys.at?.numbers.length === 3) {
        points.push({ name, at: keys.at.numbers.map((one, k) => ({ ...one, file, path: `point.${name}.${"xyz"[k]}` })) });
      }
      if (group === "mirror") isMirrored = true;
      if (group === "model") {
        axes = stringsOf(text, keys.axes)[0]?.toLowerCase() ?? axes;
        if (stringsOf(text, keys.length)[0]?.toLowerCase() === "m") length = 1;
      }
      const bodies = stringsOf(text, keys.bodies), ends = stringsOf(text, keys.at);
      if (bodies.length === 2) {
        add(bodies[0], ends[0]);
        add(bodies[1], ends[1] ?? ends[0]);
        if (ends.length === 2) pairs.push({ ends: ends.slice(0, 2), kind: group, bodies });
      }
      if (group === "wheel") for (const key of ["centre", "contact"]) add(stringsOf(text, keys.body)[0], stringsOf(text, keys[key])[0]);
      if (unlisted.includes(group) || name === undefined && !single.includes(group)) continue;
      for (const [key, { numbers }] of Object.entries(keys)) {
        const path = single.includes(group) ? `${group}.${key}` : `${group}.${name}.${key}`;
        if (numbers.length === 0) continue;
        rows.push({ path, numbers: numbers.map((one, k) => ({ ...one, file, path: numbers.length > 1 ? `${path}(${k + 1})` : path })) });
      }
    }
  }
  const known = new Set(points.map(({ name }) => name)), links = [...pairs];
  for (const [body, set] of of) {
    const list = [...set];
    for (const point of points) if (set.has(point.name)) point.body ??= body;
    for (let m = 0; m < list.length; m++) {
      for (const other of list.slice(m + 1)) links.push({ ends: [list[m], other], kind: "body", bodies: [body, body] });
    }
  }
  return { points, rows, axes, length, isMirrored, links: links.filter(({ ends }) => ends.every((end) => known.has(end))) };
}

const numbersOf = ({ points, rows }) => [...points.flatMap(({ at }) => at), ...rows.flatMap(({ numbers }) => numbers)];

// A text with other texts in place of some of its numbers
function replaceNumbers(text, list) {
  for (const [{ start, text: old }, now] of [...list].sort(([a], [b]) => b.start - a.start)) {
    text = text.slice(0, start) + now + text.slice(start + old.length);
  }
  return text;
}

// ---- changes --------------------------------------------------------------------------------------

// What differs in two texts: [start, old part, new part]
function differenceOf(old, now) {
  const least = Math.min(old.length, now.length);
  let start = 0, end = 0;
  while (start < least && old[start] === now[start]) start++;
  while (end < least - start && old[old.length - 1 - end] === now[now.length - 1 - end]) end++;
  return [start, old.slice(start, old.length - end), now.slice(start, now.length - end)];
}

// What differs in two documents with the same files, path -> text: [path, start, old part, new part]
function changesOf(old, now) {
  return [...now].filter(([path, text]) => text !== old.get(path)).map(([path, text]) => [path, ...differenceOf(old.get(path) ?? "", text)]);
}

// A text with a change, or without it again
const withChange = (text, [, start, old, now]) => text.slice(0, start) + now + text.slice(start + old.length);
const withoutChange = (text, [path, start, old, now]) => withChange(text, [path, start, now, old]);

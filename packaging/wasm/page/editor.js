// The text of the document in elastokin.html, behind deck.js: CodeMirror (`codemirror`, of editor/component.js) with the colours of a
// deck, its errors at their lines, completion and the meaning of each key from `elastokin schema`. The text has no history of its own:
// workbench.js undoes changes of text, tables and drawing in one order.
const { EditorState, EditorView } = codemirror, ofProgram = codemirror.Annotation.define();
const dictionary = { groups: {}, asked: null };      // `elastokin schema`, group -> { description, properties }

// ---- colours --------------------------------------------------------------------------------------

const numberPattern = /^[-+]?(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?/i;
const deckColours = codemirror.StreamLanguage.define({
  name: "deck",
  startState: () => ({ isInside: false }),
  copyState: (state) => ({ ...state }),
  token(stream, state) {
    if (stream.eatSpace()) return null;
    if (stream.match(/^!.*/)) return "comment";
    if (stream.match(/^&\w*/)) {
      state.isInside = true;
      return "keyword";
    }
    if (!state.isInside) {      // text between groups is an error that `check` reports
      stream.next();
      return null;
    }
    if (stream.match(/^'(?:[^']|'')*'?/) || stream.match(/^"[^"]*"?/)) return "string";
    if (stream.eat("/")) {
      state.isInside = false;
      return "keyword";
    }
    if (stream.match(/^[a-z_]\w*(?=\s*(?:\(\s*\d+\s*\)\s*)?=)/i)) return "propertyName";
    if (stream.match(/^\.(true|false)\.|^\.[tf]\./i)) return "bool";
    if (stream.match(numberPattern)) return "number";
    if (!stream.match(/^\w+/)) stream.next();
    return null;
  },
  languageData: { commentTokens: { line: "!" } },
});
const { tags } = codemirror, colouring = codemirror.HighlightStyle.define([
  { tag: tags.comment, class: "comment" }, { tag: tags.keyword, class: "group" }, { tag: tags.propertyName, class: "key" },
  { tag: tags.string, class: "string" }, { tag: [tags.number, tags.bool], class: "number" },
]);

// ---- completion and meaning -----------------------------------------------------------------------

// Asks the program for its groups and keys, once
function learnDictionary() {
  dictionary.asked ??= program.run(["schema"], []).then((result) => {
    if (result?.status === 0) dictionary.groups = JSON.parse(result.output).$defs;
    else dictionary.asked = null;
  });
  return dictionary.asked;
}

// Where a position of the text is: { group, key, quote: position of the string that it is in, or -1, used: keys of the group up to
// here }; null outside of a group
function placeOf(doc, position) {
  const line = doc.lineAt(position);
  let from = -1;
  for (let k = line.number; k > 0 && k > line.number - 500 && from < 0; k--) if (/^\s*&/.test(doc.line(k).text)) from = doc.line(k).from;
  if (from < 0) return null;
  const part = doc.sliceString(from, position), masked = maskOf(part), head = /^\s*&(\w*)/.exec(part);
  if (masked.slice(head[0].length).includes("/")) return null;
  const next = maskOf(`${part}x`).at(-1), keys = [...masked.matchAll(/([a-z_]\w*)\s*=/gi)], last = keys.at(-1);
  if (next === " ") return null;      // in a comment
  return {
    group: head[1].toLowerCase(), isName: /^\s*&\w*$/.test(part), key: last?.[1].toLowerCase() ?? "", used: keys.map(([, key]) => key.toLowerCase()),
    value: last ? masked.slice(last.index + last[0].length) : "",
    quote: next === "×" ? from + Math.max(masked.lastIndexOf("'"), masked.lastIndexOf('"')) : -1,
  };
}

const namedBy = {      // groups whose names a key takes
  point: ["at", "axis", "axis_2", "x_axis", "z_axis", "origin", "centre", "contact", "steer_axis"],
  body: ["bodies", "body", "shared"], measure: ["measure", "measures"], curve: ["curve"], load: ["load"], wheel: ["wheel"],
  joint: ["driver", "drive"], load_state: ["state"],
};

// The strings that a key takes: those that the program lists, or names of points and parts in the files of the deck
function stringsFor(group, key) {
  const card = dictionary.groups[group]?.properties[key], listed = card?.enum ?? card?.items?.enum;
  if (listed) return listed.map((label) => ({ label, type: "enum" }));
  const kinds = Object.keys(namedBy).filter((kind) => namedBy[kind].includes(key)), found = new Map();
  if (kinds.includes("body") && key !== "shared") found.set("chassis", "the car");
  if (key === "drive") found.set("wheel_travel", "");
  if (key === "file" || key === "property_file") for (const path of files.keys()) if (path !== shown) found.set(path, "");
  if (group === "target_band" && key === "quantity") for (const { value } of [...element("key-number").options].slice(1)) found.set(value, "");
  for (const file of kinds.length > 0 ? filesOfDeck(files) : []) {
    const text = files.get(file);
    for (const one of groupsOf(text)) {
      if (!kinds.includes(one.name)) continue;
      const name = stringsOf(text, one.keys.name)[0], at = one.keys.at?.numbers;
      if (name) found.set(name, one.name === "point" && at?.length === 3 ? at.map((number) => number.text).join(", ") : "");
    }
  }
  return [...found].map(([label, detail]) => ({ label, detail, type: "variable" }));
}

// The unit of a key in this document: those that &model selects stand for length, force, angle and mass
function unitOfKey(card) {
  const chosen = { length: "mm", force: "N", angle: "deg", mass: "kg" }, text = files.get(deck) ?? "";
  const model = groupsOf(text).find(({ name }) => name === "model");
  for (const kind of Object.keys(chosen)) chosen[kind] = stringsOf(text, model?.keys[kind])[0] ?? chosen[kind];
  return (card["x-unit"] ?? "").replace(/\b(length|force|angle|mass)\b/g, (kind) => chosen[kind]);
}

function factsOf(card) {
  const listed = card.enum ?? card.items?.enum, unit = unitOfKey(card), facts = [];
  if (unit) facts.push(`unit ${unit}`);
  if (card.default !== undefined) facts.push(`default ${[card.default].flat().map((one) => one === "" ? "''" : one).join(", ")}`);
  if (listed) facts.push(`one of ${listed.join(", ")}`);
  return facts.join("; ");
}

const isText = (card) => [card.type, card.items?.type, ...(card.anyOf ?? []).flatMap((one) => [one.type, one.items?.type])].includes("string");

// A key with "=", and quotes where it takes a string
function putKey(card, name) {
  return (view, completion, from, to) => {
    const text = isText(card) ? `${name} = ''` : `${name} = `, at = from + text.length - (isText(card) ? 1 : 0);
    view.dispatch({ changes: { from, to, insert: text }, selection: { anchor: at }, userEvent: "input.complete" });
    if (isText(card)) codemirror.startCompletion(view);
  };
}

// In a study or fit, of whose groups the program has no schema: paths, cases and K&C metrics of its deck
async function stringsOfStudy(key) {
  const text = files.get(shown) ?? "", study = groupsOf(text).find(({ name }) => name === "study" || name === "fit");
  const model = pathFrom(shown, stringsOf(text, study?.keys.deck)[0] ?? ""), kind = { path: "paths", case: "cases", quantity: "numbers" }[key];
  if (key === "deck") return [...files.keys()].filter((path) => path !== shown && /\.nml$/i.test(path)).map((label) => ({ label }));
  if (!kind || !files.has(model)) return [];
  const result = await program.run(["list", model, "--json"], [...files]);
  if (result?.status !== 0) return [];      // a deck with errors has no list
  return JSON.parse(result.output)[kind].map(({ path, name, value, unit }) => ({ label: path ?? name, detail: path ? `${value} ${unit}` : unit, type: "variable" }));
}

async function complete({ state, pos, explicit }) {
  await learnDictionary();
  const place = placeOf(state.doc, pos), word = /[\w.]*$/.exec(state.doc.lineAt(pos).text.slice(0, pos - state.doc.lineAt(pos).from))[0];
  if (place === null) return null;
  const from = pos - word.length, { properties } = dictionary.groups[place.group] ?? {};
  if (place.isName) {
    const groups = Object.entries(dictionary.groups).map(([label, { description }]) => ({ label, detail: description, type: "keyword" }));
    return { from, options: groups, validFor: /^\w*$/ };
  }
  if (!properties && place.quote < 0) return null;
  if (place.quote >= 0) {
    const options = properties ? stringsFor(place.group, place.key) : await stringsOfStudy(place.key);
    return options.length > 0 ? { from: place.quote + 1, options, validFor: /^[^']*$/ } : null;
  }
  const card = properties[place.key], isAfterSign = card && /^\s*[\w.]*$/.test(place.value);
  if (isAfterSign && /[^\d.+-]|^$/.test(word)) {
    const options = card.type === "boolean" ? [".true.", ".false."].map((label) => ({ label })) :
      stringsFor(place.group, place.key).map((one) => ({ ...one, label: `'${one.label}'` }));
    return options.length > 0 ? { from, options, validFor: /^[\w.]*$/ } : null;
  }
  if (word === "" && !explicit || /^[\d.]/.test(word)) return null;
  const options = Object.entries(properties).filter(([name]) => name === "note" || !place.used.includes(name)).map(([name, one]) => ({
    label: name, detail: unitOfKey(one), type: "property", apply: putKey(one, name), boost: name === "note" ? -1 : 0,
    info: [one.description, factsOf(one)].filter((text) => text !== "").join("\n"),
  }));
  return { from, options, validFor: /^\w*$/ };
}

// The meaning of the group or key under the pointer, and the coordinates of a point
async function explain(view, position) {
  await learnDictionary();
  const { from, text } = view.state.doc.lineAt(position);
  const word = [...text.matchAll(/&?\w+/g)].find((one) => from + one.index <= position && position <= from + one.index + one[0].length);
  const place = word && placeOf(view.state.doc, from + word.index + word[0].length);
  if (!place) return null;
  const meaning = dictionary.groups[place.group], name = word[0].toLowerCase(), lines = [];
  if (name.startsWith("&")) lines.push(name, meaning?.description);
  else if (place.quote >= 0) {
    const found = stringsFor(place.group, place.key).find(({ label, detail }) => label === word[0] && detail);
    if (found) lines.push(found.label, `at ${found.detail} ${unitOfKey({ "x-unit": "length" })}`);
  } else if (/^\s*(\(\s*\d+\s*\)\s*)?=/.test(text.slice(word.index + word[0].length)) && meaning?.properties[name]) {
    lines.push(name, meaning.properties[name].description, factsOf(meaning.properties[name]));
  }
  const told = lines.filter((line) => line);
  if (told.length < 2) return null;
  return {
    pos: from + word.index, end: from + word.index + word[0].length, above: true,
    create() {
      const dom = document.createElement("div");
      dom.className = "meaning";
      for (const [k, line] of told.entries()) dom.append(Object.assign(document.createElement(k ? "div" : "b"), { textContent: line }));
      return { dom };
    },
  };
}

// ---- the editor -----------------------------------------------------------------------------------

// A quote typed before the closing quote of a string goes behind it: completion writes both
function passQuote(view, from, to, typed) {
  if (typed !== "'" || from !== to || view.state.sliceDoc(from, from + 1) !== "'" || !(placeOf(view.state.doc, from)?.quote >= 0)) return false;
  view.dispatch({ selection: { anchor: from + 1 }, userEvent: "select" });
  return true;
}

const always = (act) => () => {
  act();
  return true;
};
const undoText = always(() => goBack("past")), redoText = always(() => goBack("future"));
const darkness = new codemirror.Compartment(), dark = matchMedia("(prefers-color-scheme: dark)");
const shade = () => EditorView.theme({}, { dark: dark.matches });

function extensionsFor(name) {
  return [
    codemirror.lineNumbers(), codemirror.drawSelection(), codemirror.highlightActiveLine(), codemirror.highlightSelectionMatches(),
    codemirror.search({ top: true }), codemirror.placeholder("Open a deck of the library, drop a deck here, or type one."),
    darkness.of(shade()),
    /\.nml$/i.test(name) || name === "" ? [deckColours, codemirror.syntaxHighlighting(colouring), codemirror.lintGutter(),
      codemirror.hoverTooltip(explain, { hoverTime: 250 }), codemirror.autocompletion({ override: [complete], icons: false })] : [],
    codemirror.keymap.of([{ key: "Mod-z", run: undoText }, { key: "Mod-y", run: redoText }, { key: "Mod-Shift-z", run: redoText },
      { key: "Tab", run: codemirror.acceptCompletion }, ...codemirror.completionKeymap, ...codemirror.searchKeymap,
      ...codemirror.lintKeymap, ...codemirror.defaultKeymap]),
    EditorView.inputHandler.of(passQuote),
    EditorView.contentAttributes.of({ id: "text", "aria-label": "Deck as text", spellcheck: "false", autocapitalize: "off" }),
    EditorView.domEventHandlers({
      beforeinput(event) {      // by the menu of the browser
        const act = { historyUndo: undoText, historyRedo: redoText }[event.inputType];
        if (act) event.preventDefault();
        return act ? act() : false;
      },
    }),
    EditorView.updateListener.of((update) => {
      if (update.docChanged && !update.transactions.some((one) => one.annotation(ofProgram))) textEdited(update.state.doc.toString());
    }),
  ];
}

const editor = new EditorView({ parent: element("editor"), state: EditorState.create({ extensions: extensionsFor("") }) });
dark.addEventListener("change", () => editor.dispatch({ effects: darkness.reconfigure(shade()) }));

// Another file
function openText(name, text) {
  editor.setState(EditorState.create({ doc: text, extensions: extensionsFor(name) }));
  editor.scrollDOM.scrollTop = 0;
}

// The same file with another text: only what differs is replaced, so that selection and place stay. `isShown`: scrolls to the change
function replaceText(text, isShown = false) {
  const old = editor.state.doc.toString(), [from, removed, insert] = differenceOf(old, text);
  if (removed === "" && insert === "") return;
  const selection = isShown ? { anchor: from + insert.length } : undefined;
  editor.dispatch({ changes: { from, to: from + removed.length, insert }, selection, scrollIntoView: isShown, annotations: ofProgram.of(true) });
}

// Messages of `check --json` at their lines, at their key where they name one
function markText(messages) {
  const { doc } = editor.state;
  const marks = messages.filter(({ file, line }) => file === shown && line !== null && line <= doc.lines).map((one) => {
    const line = doc.line(one.line), key = one.key === "" ? -1 : line.text.search(new RegExp(`\\b${one.key}\\s*[(=]`, "i"));
    const from = key < 0 ? line.from + line.text.search(/\S|$/) : line.from + key;
    return { from, to: key < 0 ? line.to : from + one.key.length, severity: one.severity === "remark" ? "info" : one.severity, message: one.text };
  });
  editor.dispatch(codemirror.setDiagnostics(editor.state, marks));
}

function goToLine(number) {
  const line = editor.state.doc.line(Math.min(Math.max(number, 1), editor.state.doc.lines));
  editor.dispatch({ selection: { anchor: line.from, head: line.to }, effects: EditorView.scrollIntoView(line.from, { y: "center" }) });
  editor.focus();
}

// For scripts: the text that is shown
globalThis.elastokin.text = () => editor.state.doc.toString();

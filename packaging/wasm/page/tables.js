// The tables of elastokin.html with parameters of the deck, behind workbench.js. Cells that exist are only given their values, so that
// typing is not interrupted.

// A field for a number of the document, with a button that lets `solve` change it: `find` returns the number as it is now, `step` its
// change by an arrow key.
function fieldOf(label, find, step) {
  const input = document.createElement("input");
  input.setAttribute("aria-label", label);
  input.addEventListener("change", () => {
    const value = Number(input.value.replace(",", ".").replace("−", "-"));
    if (input.value.trim() === "" || !Number.isFinite(value)) input.value = find().text;
    else setNumbers([[find(), value]]);
    remember();
  });
  input.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
    event.preventDefault();
    setNumbers([[find(), find().value + (event.key === "ArrowUp" ? 1 : -1) * step(find().value)]]);
    input.value = find().text;
    remember();
  });
  const field = document.createElement("span"), { path } = find(), free = buttonOf("◦", `Let ${path} change`, () =>
    setFree(path, !question.unknowns.has(path)));
  free.dataset.free = path;
  free.title = "Let “Solve” change this number";
  free.setAttribute("aria-pressed", String(question.unknowns.has(path)));
  field.className = "field";
  field.append(input, free);
  return field;
}

const put = (input, text) => { if (bench.isReset || !input.matches(":focus")) input.value = text; };

function headOf(words) {
  const head = document.createElement("tr");
  for (const word of words) head.append(cellOf(word));
  return head;
}

function cellOf(text) {
  const cell = document.createElement("th");
  cell.textContent = text;
  return cell;
}

function fillTables() {
  fillPoints();
  fillRates();
}

function fillPoints() {
  const table = element("coordinates"), names = bench.points.map(({ name }) => name).join("\n");
  if (table.dataset.names !== names) {
    table.dataset.names = names;
    table.replaceChildren(headOf(["Point", "x", "y", "z"]), ...bench.points.map(({ name }) => {
      const row = document.createElement("tr");
      row.append(cellOf(name));
      ["x", "y", "z"].forEach((axis, k) => {
        const field = fieldOf(`${name} ${axis}`, () => pointOf(name).at[k], stepOf);
        field.addEventListener("focusin", () => choose(name));
        row.insertCell().append(field);
      });
      return row;
    }));
  }
  bench.points.forEach(({ name, at }, k) => {
    const row = table.rows[k + 1];
    row.className = name === bench.chosen ? "chosen" : "";
    at.forEach(({ text }, m) => put(row.cells[m + 1].querySelector("input"), text));
  });
}

// Rates, lengths and all other parameters of the deck that the program lists, with their units
function fillRates() {
  const table = element("rates"), rows = bench.rows.filter(({ numbers }) => numbers.every(({ path }) => bench.units.has(path)));
  const paths = rows.map(({ path, numbers }) => `${path} ${numbers.length} ${bench.units.get(numbers[0].path)}`).join("\n");
  if (table.dataset.paths !== paths) {
    table.dataset.paths = paths;
    table.replaceChildren(headOf(["Number", "value", "unit"]), ...rows.map(({ path, numbers }) => {
      const row = document.createElement("tr"), cell = document.createElement("td");
      const find = (k) => bench.rows.find((one) => one.path === path).numbers[k];
      cell.append(...numbers.map((one, k) => fieldOf(one.path, () => find(k), percentOf)));
      row.append(cellOf(path), cell, document.createElement("td"));
      row.cells[2].textContent = bench.units.get(numbers[0].path) || "–";
      return row;
    }));
  }
  rows.forEach(({ numbers }, k) => numbers.forEach(({ text }, m) => put(table.rows[k + 1].cells[1].children[m].firstChild, text)));
}

const percentOf = (value) => value === 0 ? stepOf() : Number((0.01 * Math.abs(value)).toPrecision(1));

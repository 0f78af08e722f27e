// A baseline and the document compared in elastokin.html, behind ask.js: the lines of the assessment of both reports, all K&C metrics
// that have changed, and the page of `elastokin compare`.
const comparison = { isRunning: false };

// The lines of the assessment in key_numbers.json: domain -> texts
const assessmentOf = ({ written }) => {
  const lines = new Map(), file = written.find(([path]) => path.endsWith("key_numbers.json"));
  for (const { domain, text } of file ? JSON.parse(textOf(file[1])).assessment : []) lines.set(domain, [...lines.get(domain) ?? [], text]);
  return new Map([...lines].map(([domain, texts]) => [domain, texts.join("; ")]));
};

// Why a report is missing, or null
const lackOf = (result) => result === null ? "Stopped." : result.written.length === 0 || result.trap ? firstLine(result) : null;

async function compareAll() {
  const base = bench.baselines.find(({ name }) => name === element("baselines").value);
  if (!base || comparison.isRunning) return;
  const box = element("comparison"), before = snapshot(), reports = [], folders = [`/compared/${base.name.replace(/[^\w.-]+/g, "_")}`, "/compared/now"];
  comparison.isRunning = true;
  box.className = "bar top";
  box.textContent = "report …";
  for (const [k, given] of [base.text, files].entries()) {
    const result = await program.run(["report", deck, "--no-plots", "--out", folders[k]], [...given]), lack = lackOf(result);
    reports.push(result);
    if (lack === null) continue;
    box.textContent = `No report of ${k === 0 ? base.name : "the document"}: ${lack}`;
    comparison.isRunning = false;
    return;
  }
  const written = reports.flatMap((report) => report.written);
  const result = await program.run(["compare", ...folders, "--no-plots", "--quiet", "--out", "/compared/out"], written), lack = lackOf(result);
  comparison.isRunning = false;
  if (lack !== null) {
    box.textContent = `Not compared: ${lack}`;
    return;
  }
  const made = result.written.map(([path, content]) => [relative(path), content]), page = made.find(([path]) => path.endsWith("compare.html"));
  const [old, now] = reports.map(assessmentOf);
  const lines = [...now].map(([name, text]) => [name, old.get(name) ?? "–", text]);
  const numbers = rowsOf({ written: made.map(([path, content]) => [path, textOf(content)]) }, "number-differences.csv");
  const changed = numbers.filter(({ verdict }) => verdict !== "same").sort((a, b) => Math.abs(b.percent) - Math.abs(a.percent) || 0);
  const assessment = tableWith(`Assessment of ${base.name} and now`, ["", base.name, "now"], lines);
  [...assessment.rows].slice(1).forEach((row, k) => row.classList.toggle("changed", lines[k][1] !== lines[k][2]));
  box.replaceChildren(assessment,
    tableWith(`${changed.length} of ${numbers.length} K&C metrics changed by more than 1 %`, ["K&C metric", base.name, "now", "Δ", "%", "unit"],
      changed.map(({ name, a, b, difference: change, percent, unit }) => [name, Number(a), Number(b), Number(change), Number(percent), unit])));
  if (page) {
    showPage(page);
    box.append(buttonOf("Show the curves of both as a page", "Show the page of the comparison", () => openTab("page")));
  }
  comparison.of = before;
}

// The comparison belongs to a former document
function fadeComparison() {
  const box = element("comparison");
  if (box.textContent !== "" && !comparison.isRunning) box.classList.toggle("stale", comparison.of !== snapshot());
}
element("compare").addEventListener("click", compareAll);
document.addEventListener("solved", fadeComparison);
document.addEventListener("opened", () => element("comparison").replaceChildren());

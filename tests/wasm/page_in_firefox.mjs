// node page_in_firefox.mjs MODULES PAGE FOLDER: elastokin.html in headless Firefox (needs puppeteer-core in MODULES/node_modules):
// check, run and report of a deck, ten seeded drags of points whose curves are those of `run --set-file`,
// completion, undo and a wrong deck, a document that stays when the page is closed; no message on the console, no request. Exit status 1 with a line per failure.
import { createRequire } from "node:module";
import { mkdirSync, rmSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, pageFile, folder] = process.argv.slice(2).map((word) => resolve(word));
const puppeteer = createRequire(`${modules}/`)("puppeteer-core");
const patient = 120000, failures = [], messages = [], requests = [];
const require_ = (isGood, text) => { if (!isGood) failures.push(text); };
rmSync(`${folder}/profile`, { recursive: true, force: true });      // the document of an earlier run
mkdirSync(folder, { recursive: true });

const browser = await puppeteer.launch({ browser: "firefox", executablePath: process.env.EK_FIREFOX ?? "/usr/bin/firefox-esr", headless: true,
  protocolTimeout: patient, userDataDir: `${folder}/profile`, args: ["--width=1280", "--height=900"] });

async function open() {
  const page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 900 });
  page.setDefaultTimeout(patient);
  page.on("console", (message) => messages.push(message.text()));
  page.on("pageerror", (error) => messages.push(String(error)));
  page.on("request", (request) => { if (!/^(file|blob|data|about):/.test(request.url())) requests.push(request.url()); });
  page.on("dialog", (dialog) => dialog.accept());
  await page.goto(pathToFileURL(pageFile).href);
  return page;
}

let page = await open();
// Repeats a question to the page until its answer is true: the page allows no eval, which waitForFunction needs
async function until(question, what, ...words) {
  const end = Date.now() + patient;
  while (Date.now() < end) {
    const found = await page.evaluate(question, ...words);
    if (found) return found;
    await new Promise((wait) => setTimeout(wait, 30));
  }
  throw new Error(`not seen: ${what}`);
}
const said = (text) => until((wanted) => document.getElementById("status").textContent.includes(wanted), text, text);
try {
  const start = Date.now();
  await said("Ready");
  console.log(`${await browser.version()}: ready after ${((Date.now() - start) / 1000).toFixed(2)} s`);
  await page.select("#library", "mcpherson_axle");
  await said("check: done");
  await page.click("[data-command=run]");
  await said("run: done");
  require_(await page.evaluate(() => document.querySelectorAll("#table tr").length) > 50, "the table has no rows");
  await page.click("[data-command=report]");
  await said("report: done");
  await page.click("[data-tab=points]");

  const curves = () => until(() => {
    const found = elastokin.curves();
    return found.isCurrent && found.columns && Object.keys(found.columns).length > 0 ? found : null;
  }, "curves");
  async function agrees(what) {
    const drawn = await curves();
    const result = await page.evaluate(async () => elastokin.command(["run", "mcpherson_axle.nml", "--case", "parallel_travel", "--increments",
      "20", "--set-file", "changes.set", "--out", "out"], { "mcpherson_axle.nml": original, "changes.set": changes() }));
    const text = result.files["out/mcpherson_axle_parallel_travel.csv"];
    const isBad = await page.evaluate(() => document.getElementById("said").className === "bad");
    require_((text !== undefined) !== isBad, `${what}: status ${result.status}, but the page says the opposite`);
    if (text === undefined) return false;
    const rows = text.split("\n").filter((row) => row !== "" && !row.startsWith("#")).map((row) => row.split(","));
    for (const [name, values] of Object.entries(drawn.columns)) {
      const column = rows[0].indexOf(name), wanted = rows.slice(1).map((row) => row[column] === "" ? NaN : Number(row[column]));
      const near = 1e-9 * Math.max(1, ...wanted.filter((value) => !Number.isNaN(value)).map(Math.abs));
      const isSame = wanted.length === values.length && wanted.every((value, k) =>
        Math.abs(value - values[k]) <= near || Number.isNaN(value) && (values[k] === null || Number.isNaN(values[k])));
      require_(isSame, `${what}: ${name} is not that of the run`);
    }
    return true;
  }
  await page.evaluate(() => { globalThis.original = elastokin.text(); });
  await agrees("as opened");
  let seed = 51;
  const chance = (n) => { seed = (seed * 48271) % 2147483647; return seed % n; };
  const before = (await curves()).runs, begun = Date.now();
  let solved = 0;
  for (let k = 0; k < 10; k++) {
    const dots = await page.$$("#views circle"), dot = dots[chance(dots.length)];
    await dot.scrollIntoView();
    const box = await dot.boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let m = 1; m <= 5; m++) await page.mouse.move(x + m * (2 * chance(2) - 1), y + m * (2 * chance(2) - 1));
    await page.mouse.up();
    if (await agrees(`drag ${k}`)) solved++;
    else await page.click("#undo");
  }
  console.log(`10 drags, ${solved} solved: ${(await curves()).runs - before} solutions in ${((Date.now() - begun) / 1000).toFixed(1)} s, with the comparisons`);
  require_(solved >= 5, `only ${solved} of 10 drags gave an axle`);
  // how many redraws a second: 300 moves of one point
  const rate = await page.evaluate(async () => {
    const dot = document.querySelector("circle[aria-label='tie_rod_outer, Side view']"), box = dot.getBoundingClientRect(), gaps = [];
    const event = (kind, x, y) => new PointerEvent(kind, { clientX: box.x + x, clientY: box.y + y, bubbles: true, cancelable: true });
    dot.dispatchEvent(event("pointerdown", 0, 0));
    for (let k = 0; k < 300; k++) {
      const start = performance.now(), runs = elastokin.curves().runs;
      dispatchEvent(event("pointermove", 6 * Math.sin(k), 6 * Math.cos(1.3 * k)));
      do await new Promise(requestAnimationFrame);
      while (elastokin.curves().runs === runs && !elastokin.curves().isCurrent);
      gaps.push(performance.now() - start);
    }
    dispatchEvent(event("pointerup", 0, 0));
    return 1000 / gaps.sort((a, b) => a - b)[150];
  });
  console.log(`300 moves of a point: ${rate.toFixed(1)} redraws a second`);
  await agrees("after 300 moves");
  await page.screenshot({ path: `${folder}/firefox.png` });

  await page.click("[data-tab=messages]");
  await page.focus("#text");
  await page.keyboard.down("Control");
  await page.keyboard.press("Home");
  await page.keyboard.up("Control");
  const text = await page.evaluate(() => elastokin.text());
  await page.keyboard.type("&bus");
  await until(() => document.querySelector(".cm-completionLabel")?.textContent === "bushing", "completion of a group");
  await new Promise((wait) => setTimeout(wait, 200));      // the list is not taken in its first moment
  await page.keyboard.press("Enter");
  require_((await page.evaluate(() => elastokin.text())) === `&bushing${text}`, "completion does not write the group");
  await page.keyboard.down("Control");
  await page.keyboard.press("z");
  await page.keyboard.up("Control");
  require_((await page.evaluate(() => elastokin.text())) === text, "undo does not take back what was typed");
  await page.keyboard.type("&jiont /");
  await said("check: error in the deck");
  require_((await page.evaluate(() => document.getElementById("messages").textContent)).includes("there is no group &jiont"), "no message on a wrong group");
  await page.close();
  page = await open();
  await until(() => elastokin.text().includes("&jiont"), "the document of the closed page");
} catch (error) {
  failures.push(String(error));
}
await browser.close();
require_(messages.length === 0, `the page wrote to the console: ${messages.slice(0, 3)}`);
require_(requests.length === 0, `the page requested ${requests.slice(0, 3)}`);
for (const text of failures) console.log(`FAILED: ${text}`);
console.log(`the page in Firefox: ${failures.length} failures`);
process.exit(failures.length > 0 ? 1 : 0);

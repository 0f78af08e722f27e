// Start of elastokin.html, behind page.js and workbench.js.
showTable();
if (missing.length > 0) say(`This browser has no ${missing.join(", ")}; a newer one is needed.`, "bad");
else {
  program = new Program();
  program.ready.then(() => {
    setTimeout(listKinds, 300);      // after the first curves
    if (restore()) return;
    if (folder) return openDocument(folder.files);
    say("Ready. Open a deck of the library, or drop a deck here.", "good");
  }, (error) => say(`The program cannot run in this browser: ${error.message}`, "bad"));
}

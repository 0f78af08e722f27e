"""elastokin-lsp: a language server for decks. It completes and explains groups, keys and names, and shows the errors of
`elastokin check` while a deck is edited. Requires pygls: pip install "elastokin[lsp]"."""

from __future__ import annotations

import argparse
import asyncio
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer
from pygls.uris import from_fs_path, to_fs_path

from . import __version__
from ._deck_schema import Key, Schema
from ._deck_text import Place, Record, included, place_at, records_of, with_included

_PAUSE = 0.25  # seconds without an edit before the deck is checked
_OTHER_FILES = ("study", "fit", "channel")  # first groups of a study, a fit and a map of channels, which are not decks
_SEVERITY = {"error": lsp.DiagnosticSeverity.Error, "warning": lsp.DiagnosticSeverity.Warning, "remark": lsp.DiagnosticSeverity.Information}
_STANDARD_INPUT = "standard input"  # name of a deck from standard input in messages


def program_words(given: str | None) -> list[str]:
    """The command of the program: --program, EK_PROGRAM, the program of this package, or elastokin on the PATH."""
    named = given or os.environ.get("EK_PROGRAM")
    if named:
        return [os.path.abspath(named)]
    folder = Path(__file__).parent
    if (folder / "bin" / "elastokin").exists():
        return [str(folder / "bin" / "elastokin")]
    if (folder / "elastokin.wasm").exists():
        return [sys.executable, "-m", "elastokin"]
    found = shutil.which("elastokin")
    if not found:
        sys.exit("elastokin-lsp: there is no program elastokin in this package or on the PATH; give it with --program PATH")
    return [found]


class DeckServer(LanguageServer):
    """The server: the program, its schema, the checks that run, and the files for which each deck has published messages."""

    def __init__(self, program: list[str]) -> None:
        super().__init__("elastokin-lsp", f"v{__version__}")
        self.program = program
        self.schema = Schema(json.loads(subprocess.run([*program, "schema"], check=True, capture_output=True).stdout))
        self.checks: dict[str, asyncio.Task[None]] = {}
        self.published: dict[str, set[str]] = {}

    def text_of(self, uri: str) -> str:
        """The text of an open document, with changes that are not saved."""
        return self.workspace.get_text_document(uri).source

    def lines_of(self, uri: str) -> list[str]:
        """The lines of a document or of a file; none if it cannot be read."""
        try:
            return self.text_of(uri).split("\n")
        except (OSError, ValueError):
            return []

    def is_deck(self, records: list[Record]) -> bool:
        """Whether the file has groups of a deck, and is no study, fit or map."""
        groups = [record.group for record in records]
        return any(group in self.schema.keys for group in groups) and groups[0] not in _OTHER_FILES

    # ---- messages ---------------------------------------------------------------------------------------------------------------

    def check_soon(self, uri: str, pause: float = _PAUSE) -> None:
        """Checks a document after a pause. A check of the same document that has not ended is stopped."""
        if uri in self.checks:
            self.checks[uri].cancel()
        self.checks[uri] = asyncio.get_running_loop().create_task(self.check(uri, pause))

    async def check(self, uri: str, pause: float) -> None:
        """Checks a deck from its text, or the decks that include a part of a deck from their files, and publishes the messages."""
        await asyncio.sleep(pause)
        text, path = self.text_of(uri), path_of(uri)
        records = records_of(text)
        if not self.is_deck(records):
            self.publish(uri, {})
        elif any(record.group == "model" for record in with_included(text, path)):
            self.publish(uri, self.located(await self.run_check("-", path, text), path))
        elif not path.exists() or path.read_bytes() == text.encode():
            self.publish(uri, await self.messages_of_part(path))

    async def messages_of_part(self, path: Path) -> dict[str, list[lsp.Diagnostic]]:
        """The messages on a part of a deck, from all decks of its folder that include it."""
        here, decks, found = from_fs_path(str(path)) or "", 0, []
        for deck in sorted(path.parent.glob("*.nml")):
            if not includes(deck, path):
                continue
            decks += 1
            for one in self.located(await self.run_check(deck.name, deck), deck).get(here, []):
                if one not in found:
                    found.append(one)
        if decks == 0:
            words = "no deck in this folder has &model and includes this file; it is not checked"
            found = [lsp.Diagnostic(range_of("", 0, []), words, severity=lsp.DiagnosticSeverity.Information, source="elastokin")]
        return {here: found}

    async def run_check(self, name: str, path: Path, text: str | None = None) -> list[dict[str, Any]]:
        """The messages of `elastokin check NAME --json` in the folder of the deck; a check that fails is a message."""
        folder = path.parent if path.parent.is_dir() else Path.cwd()
        pipe = asyncio.subprocess.PIPE
        process = await asyncio.create_subprocess_exec(
            *self.program, "check", name, "--json", stdin=pipe, stdout=pipe, stderr=asyncio.subprocess.DEVNULL, cwd=folder
        )
        try:
            out, _ = await process.communicate((text or "").encode())
            found: list[dict[str, Any]] = json.loads(out)["messages"]
            return found
        except (ValueError, KeyError):
            words = f"{' '.join(self.program)} check ended with status {process.returncode} and without messages"
            return [{"severity": "error", "file": "", "line": None, "group": "", "key": "", "text": words}]
        finally:
            if process.returncode is None:
                process.kill()

    def located(self, messages: list[dict[str, Any]], path: Path) -> dict[str, list[lsp.Diagnostic]]:
        """Messages by the URI of their file. A message without a line is at &model."""
        found: dict[str, list[lsp.Diagnostic]] = {}
        texts: dict[str, list[str]] = {}
        for message in messages:
            has_line = message["line"] is not None
            is_own = message["file"] in ("", _STANDARD_INPUT) or not has_line
            uri = from_fs_path(str(path if is_own else path.parent / message["file"])) or ""
            if uri not in texts:
                texts[uri] = self.lines_of(uri)
            lines = texts[uri]
            line = message["line"] - 1 if has_line else next((k for k, one in enumerate(lines) if one.lower().startswith("&model")), 0)
            words = message["text"].replace(_STANDARD_INPUT, path.name)
            rest = re.sub(r"^\w+ '[^']*': ", "", words)  # without the name of the record
            what = [*re.findall(r"'([^']+)'", rest), message["key"], *re.findall(r"&(\w+)", rest)] if has_line else []
            one = lsp.Diagnostic(
                range_of(lines[line] if line < len(lines) else "", line, what),
                words,
                severity=_SEVERITY[message["severity"]],
                source="elastokin",
            )
            found.setdefault(uri, []).append(one)
        return found

    def publish(self, uri: str, found: dict[str, list[lsp.Diagnostic]]) -> None:
        """Publishes the messages that a deck has given, also for its included files, and removes those of the check before."""
        own = from_fs_path(str(path_of(uri))) or uri
        found = {uri if where == own else where: those for where, those in found.items()}
        for where in {uri, *self.published.get(uri, set()), *found}:
            self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(where, found.get(where, [])))
        self.published[uri] = set(found)

    # ---- completion and hover ---------------------------------------------------------------------------------------------------

    def completions(self, uri: str, position: lsp.Position) -> list[lsp.CompletionItem]:
        """Groups, keys, accepted strings and names that fit at the cursor."""
        document = self.workspace.get_text_document(uri)
        text = document.source
        offset = document.offset_at_position(position)
        place = place_at(text, offset)
        if place.kind == "comment":
            return []
        model = model_of(records_of(text))
        if place.record is None:
            mark = "" if place.kind == "group" else "&"
            return [
                item(group, f"{mark}{group} ", place.prefix, position, lsp.CompletionItemKind.Class, about=about)
                for group, about in self.schema.about.items()
            ]
        found: list[lsp.CompletionItem] = []
        group = place.record.group
        key = self.schema.key(group, place.entry.name()) if place.entry else None
        if key and place.may_be_value:
            found += self.values(key, place, position, with_included(text, path_of(uri)))
        if place.may_be_key and place.kind != "string":
            given = {entry.name() for entry in place.record.entries}
            found += [
                item(name, f"{name} = ", place.prefix, position, lsp.CompletionItemKind.Property, "01"[not row.is_required],
                     row.unit_in(model), row.text(group, model))
                for name, row in self.schema.keys.get(group, {}).items()
                if name not in given
            ]
        return found

    def values(self, key: Key, place: Place, position: lsp.Position, records: list[Record]) -> list[lsp.CompletionItem]:
        """The strings, names and switches that a key accepts."""
        mark = "" if place.kind == "string" else "'"
        kind = lsp.CompletionItemKind
        if key.is_switch:
            return [item(word, word, place.prefix, position, kind.Value) for word in (".true.", ".false.")]
        found = [item(word, f"{mark}{word}{mark}", place.prefix, position, kind.EnumMember) for word in key.accepted]
        prefix = place.prefix[len(re.sub(r"\w*$", "", place.prefix)) :]  # of 'fx=-name' the name
        for record in names_of(records, key.names).values():
            name = record.value("name")
            found.append(item(name, f"{mark}{name}{mark}", prefix, position, kind.Reference, detail=f"&{key.names}", about=record.value("note")))
        found += [item(word, f"{mark}{word}{mark}", prefix, position, kind.Reference, detail="in every deck") for word in key.built_in]
        return found

    def hover(self, uri: str, position: lsp.Position) -> lsp.Hover | None:
        """Meaning, unit and default of the group or key at the cursor, or the record that a name refers to."""
        document = self.workspace.get_text_document(uri)
        text, offset = document.source, document.offset_at_position(position)
        record = next((one for one in records_of(text) if one.start <= offset < one.end), None)
        if record is None or record.group not in self.schema.keys:
            return None
        model = model_of(records_of(text))
        if offset <= record.start + len(record.group):
            return hover_of(f"**&{record.group}**: {self.schema.about[record.group]}")
        for entry in record.entries:
            key = self.schema.key(record.group, entry.name())
            if key and entry.key.start <= offset < entry.key.end:
                return hover_of(key.text(record.group, model))
            for value in entry.values:
                if key and value.start <= offset < value.end:
                    named = self.named(key, value.content(), uri)
                    return hover_of(named[1] if named else key.text(record.group, model))
        return None

    def named(self, key: Key, value: str, uri: str) -> tuple[Record, str] | None:
        """The record that a value of a key names, with its location and its text."""
        text, path = self.text_of(uri), path_of(uri)
        names = names_of(with_included(text, path), key.names)
        record = names.get(value.lower().rpartition("=")[2].lstrip("-"))
        if record is None:
            return None
        source = text if record.path is None else record.path.read_text("utf-8", "replace")
        where = (record.path or path).name
        return record, f"`&{key.names}` {where}:{record.line + 1}\n```\n{source[record.start : record.end]}\n```"

    def definition(self, uri: str, position: lsp.Position) -> lsp.Location | None:
        """The record that the name at the cursor refers to."""
        document = self.workspace.get_text_document(uri)
        offset = document.offset_at_position(position)
        for record in records_of(document.source):
            for entry in record.entries:
                key = self.schema.key(record.group, entry.name())
                for value in entry.values:
                    if key and value.start <= offset < value.end:
                        named = self.named(key, value.content(), uri)
                        if named is None:
                            return None
                        line = lsp.Position(named[0].line, 0)
                        where = from_fs_path(str(named[0].path)) if named[0].path else uri
                        return lsp.Location(where or uri, lsp.Range(line, line))
        return None


def path_of(uri: str) -> Path:
    """The path of a document; a document without a file is in the working folder."""
    return Path(to_fs_path(uri) or "untitled.nml")


def model_of(records: list[Record]) -> Record | None:
    """The record of &model."""
    return next((record for record in records if record.group == "model"), None)


def names_of(records: list[Record], group: str) -> dict[str, Record]:
    """The records of a group that have a name, by this name in lower case."""
    return {record.value("name").lower(): record for record in records if record.group == group and record.value("name")}


def includes(deck: Path, path: Path) -> bool:
    """Whether a deck includes a file, directly or through another file."""
    try:
        text = deck.read_text("utf-8", "replace")
    except OSError:
        return False
    records = with_included(text, deck)
    named = [included(record, record.path or deck) for record in records]
    return model_of(records) is not None and any(one is not None and one.resolve() == path.resolve() for one in named)


def range_of(line: str, number: int, words: list[str]) -> lsp.Range:
    """The first of the words that the line contains, or the line without blanks at its ends."""
    start, end = len(line) - len(line.lstrip()), len(line.rstrip())
    for word in words:
        found = re.search(rf"(?<!\w){re.escape(word)}(?!\w)", line, re.IGNORECASE) if word else None
        if found:
            start, end = found.span()
            break
    columns = [len(line[:k].encode("utf-16-le")) // 2 for k in (start, max(start, end))]
    return lsp.Range(lsp.Position(number, columns[0]), lsp.Position(number, columns[1]))


def item(
    label: str,
    text: str,
    prefix: str,
    position: lsp.Position,
    kind: lsp.CompletionItemKind,
    order: str = "",
    detail: str = "",
    about: str = "",
) -> lsp.CompletionItem:
    """A completion that replaces the prefix before the cursor."""
    start = lsp.Position(position.line, position.character - len(prefix.encode("utf-16-le")) // 2)
    return lsp.CompletionItem(
        label,
        kind=kind,
        detail=detail or None,
        documentation=lsp.MarkupContent(lsp.MarkupKind.Markdown, about) if about else None,
        sort_text=order + label,
        text_edit=lsp.TextEdit(lsp.Range(start, position), text),
    )


def hover_of(text: str) -> lsp.Hover:
    """A hover with a text in Markdown."""
    return lsp.Hover(lsp.MarkupContent(lsp.MarkupKind.Markdown, text))


def new_server(program: list[str]) -> DeckServer:
    """The server with its answers to an editor."""
    server = DeckServer(program)

    @server.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    async def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        server.check_soon(params.text_document.uri, 0.0)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    async def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        server.check_soon(params.text_document.uri)

    @server.feature(lsp.TEXT_DOCUMENT_DID_SAVE)
    async def saved(_: lsp.DidSaveTextDocumentParams) -> None:
        for uri in list(server.checks):  # a deck may include the saved file
            server.check_soon(uri, 0.0)

    @server.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    async def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        uri = params.text_document.uri
        check = server.checks.pop(uri, None)
        if check:
            check.cancel()
        server.publish(uri, {})

    @server.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=["&", "'", '"', "=", ","]))
    def complete(params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
        return server.completions(params.text_document.uri, params.position)

    @server.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        return server.hover(params.text_document.uri, params.position)

    @server.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> lsp.Location | None:
        return server.definition(params.text_document.uri, params.position)

    return server


def main() -> None:
    """Runs the server on standard input and output."""
    parser = argparse.ArgumentParser(prog="elastokin-lsp", description="Language server for decks of elastokin, on standard input and output.")
    parser.add_argument("--program", metavar="PATH", help="the program elastokin; default: EK_PROGRAM, that of the package, or on the PATH")
    parser.add_argument("--stdio", action="store_true", help="accepted for editors that give it; the server always uses standard input and output")
    parser.add_argument("--version", action="version", version=f"elastokin-lsp {__version__}")
    new_server(program_words(parser.parse_args().program)).start_io()


if __name__ == "__main__":
    main()

"""The language server, driven by a client of pygls over standard input and output; without pygls the tests are skipped."""

import asyncio
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any

HAS_PYGLS = importlib.util.find_spec("pygls") is not None
if HAS_PYGLS:
    from lsprotocol import types as lsp
    from pygls.lsp.client import LanguageClient
    from pygls.uris import from_fs_path

TOP = Path(__file__).resolve().parents[2]
INPUT = TOP / "input"
AXLE = INPUT / "mcpherson_axle" / "mcpherson_axle.nml"


@unittest.skipUnless(HAS_PYGLS, "no pygls")
class Editing(unittest.IsolatedAsyncioTestCase):
    async def asyncSetUp(self) -> None:
        asyncio.get_running_loop().slow_callback_duration = 10.0  # a busy machine is not reported
        self.folder = tempfile.TemporaryDirectory()
        self.client = LanguageClient("test", "1")
        self.messages: asyncio.Queue[Any] = asyncio.Queue()

        @self.client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def received(params: Any) -> None:
            self.messages.put_nowait(params)

        await self.client.start_io(sys.executable, "-m", "elastokin.lsp", env=dict(os.environ))
        found = await self.client.initialize_async(lsp.InitializeParams(capabilities=lsp.ClientCapabilities()))
        self.assertEqual(found.server_info.name, "elastokin-lsp")
        self.client.initialized(lsp.InitializedParams())

    async def asyncTearDown(self) -> None:
        await self.client.shutdown_async(None)
        self.client.exit(None)
        await self.client.stop()
        self.folder.cleanup()

    def open(self, text: str, path: Path | None = None) -> str:
        """Opens a text as a document of a file that may not exist; its URI."""
        uri = from_fs_path(str(path or Path(self.folder.name) / "axle.nml"))
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(lsp.TextDocumentItem(uri, "elastokin", 1, text)))
        self.text = text
        return uri

    async def published(self, uri: str) -> list[Any]:
        """The next messages on a document."""
        while True:
            params = await asyncio.wait_for(self.messages.get(), 60)
            if params.uri == uri:
                return list(params.diagnostics)

    def after(self, word: str) -> Any:
        """The position behind the first occurrence of a word in the text."""
        before = self.text[: self.text.index(word) + len(word)]
        return lsp.Position(before.count("\n"), len(before.rpartition("\n")[2]))

    async def completed(self, text: str) -> dict[str, Any]:
        """The completions at the first | of a text, by their label."""
        before, _, after = text.partition("|")
        uri = self.open(before + after)
        document = lsp.TextDocumentIdentifier(uri)
        found = await self.client.text_document_completion_async(lsp.CompletionParams(document, self.after(before)))
        self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(document))
        return {one.label: one for one in found}

    async def hovered(self, uri: str, word: str) -> str:
        """The text of the hover behind a word."""
        position = self.after(word)
        position.character -= 1
        found = await self.client.text_document_hover_async(lsp.HoverParams(lsp.TextDocumentIdentifier(uri), position))
        return found.contents.value if found else ""

    async def test_a_deck_of_the_library_has_no_messages(self) -> None:
        self.assertEqual(await self.published(self.open(AXLE.read_text(), AXLE)), [])

    async def test_all_errors_are_shown_at_their_lines_while_the_text_is_not_saved(self) -> None:
        uri = self.open(AXLE.read_text(), AXLE)
        self.assertEqual(await self.published(uri), [])
        lines = AXLE.read_text().split("\n")
        wanted = {}
        for old, new, word, first in (("&bushing", "&bushng", "bushng", 60), ("kt =", "kkt =", "kkt", 70), ("'lca'", "'lcaa'", "lcaa", 40)):
            line = next(k for k, one in enumerate(lines) if old in one and k > first)
            lines[line] = lines[line].replace(old, new, 1)
            wanted[line] = word
        wanted[next(k for k, one in enumerate(lines) if "&spring" in one)] = ""
        lines = [one.replace("&spring", "&spring rate = -1,", 1) for one in lines]
        change = lsp.TextDocumentContentChangeWholeDocument("\n".join(lines))
        document = lsp.VersionedTextDocumentIdentifier(2, uri)
        self.client.text_document_did_change(lsp.DidChangeTextDocumentParams(document, [change]))
        found = await self.published(uri)
        for line, word in wanted.items():
            here = [one for one in found if one.range.start.line == line]
            self.assertTrue(here, (line, word, found))
            self.assertEqual({one.severity for one in here}, {lsp.DiagnosticSeverity.Error})
            marked = {lines[line][one.range.start.character : one.range.end.character] for one in here}
            self.assertTrue(not word or word in marked, (word, marked))
        self.assertNotIn("standard input", " ".join(one.message for one in found))
        # the text without the errors
        change = lsp.TextDocumentContentChangeWholeDocument(AXLE.read_text())
        self.client.text_document_did_change(
            lsp.DidChangeTextDocumentParams(lsp.VersionedTextDocumentIdentifier(3, uri), [change])
        )
        self.assertEqual(await self.published(uri), [])

    async def test_files_that_a_deck_names_are_found_from_its_folder(self) -> None:
        deck = INPUT / "solid_axle" / "solid_axle.nml"
        self.assertEqual(await self.published(self.open(deck.read_text(), deck)), [])

    async def test_a_remark_is_information_and_a_message_without_a_line_is_shown_at_model(self) -> None:
        text = (INPUT / "mcpherson" / "mcpherson.nml").read_text().replace("rate = 30.0", "rate = 9000.0")
        found = await self.published(self.open(text))
        self.assertEqual([one.severity for one in found], [lsp.DiagnosticSeverity.Information])
        self.assertIn("name = 'coil'", text.split("\n")[found[0].range.start.line])
        found = await self.published(self.open("! without a body\n&model name = 'a' /\n", Path(self.folder.name) / "empty.nml"))
        self.assertEqual([(one.range.start.line, one.severity) for one in found], [(1, lsp.DiagnosticSeverity.Error)])

    async def test_errors_of_an_included_file_are_published_for_this_file_and_removed_when_the_deck_is_closed(self) -> None:
        folder = Path(self.folder.name)
        part = folder / "part.nml"
        part.write_text("&point name = 'a', at = 1, 2, 3 /\n&point name = 'b', att = 1, 2, 3 /\n")
        uri = self.open("&model name = 'm' /\n&include file = 'part.nml' /\n&body name = 'c' /\n", folder / "deck.nml")
        other = from_fs_path(str(part))
        found = await self.published(other)
        self.assertEqual({one.range.start.line for one in found}, {1})
        self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(uri)))
        self.assertEqual(await self.published(other), [])

    async def test_a_part_of_a_deck_is_checked_with_the_deck_that_includes_it(self) -> None:
        folder = Path(self.folder.name)
        part = folder / "part.nml"
        part.write_text("&point name = 'a', at = 1, 2, 3 /\n&point name = 'b', att = 1, 2, 3 /\n")
        uri = self.open(part.read_text(), part)
        found = await self.published(uri)
        self.assertIn("no deck in this folder", found[0].message)
        (folder / "deck.nml").write_text("&model name = 'm' /\n&include file = 'part.nml' /\n&body name = 'c' /\n")
        self.client.text_document_did_save(lsp.DidSaveTextDocumentParams(lsp.TextDocumentIdentifier(uri)))
        found = await self.published(uri)
        self.assertEqual({one.range.start.line for one in found}, {1})
        self.assertIn("att", " ".join(one.message for one in found))

    async def test_a_study_and_another_namelist_file_have_no_messages(self) -> None:
        for text in ("&study kind = 'grid', deck = 'a.nml' /\n", "&domain nx = 3 /\n"):
            uri = self.open(text, Path(self.folder.name) / "other.nml")
            self.assertEqual(await self.published(uri), [])
            self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(uri)))
            await self.published(uri)

    async def test_groups_are_completed_outside_of_a_record(self) -> None:
        for text, prefix in (("&model name = 'a' /\n&bu|", "bu"), ("&model name = 'a' /\n|", "")):
            found = await self.completed(text)
            self.assertIn("bushing", found)
            self.assertEqual(found["bushing"].text_edit.new_text, "bushing " if prefix else "&bushing ")
            self.assertEqual(found["bushing"].text_edit.range.start.character, 1 if prefix else 0)
            self.assertEqual(found["bushing"].documentation.value, "a bushing")

    async def test_keys_that_a_record_does_not_have_yet_are_completed_in_the_units_of_the_deck(self) -> None:
        found = await self.completed("&model name = 'a', length = 'm', force = 'kN' /\n&bushing name = 'b', k|\n")
        self.assertNotIn("name", found)
        self.assertNotIn("rate", found)
        self.assertEqual((found["kt"].detail, found["kr"].detail), ("kN/m", "kN m/deg"))
        self.assertEqual(found["kt"].text_edit.new_text, "kt = ")
        self.assertLess(found["bodies"].sort_text, found["kt"].sort_text)  # required keys first

    async def test_accepted_strings_and_switches_are_completed(self) -> None:
        found = await self.completed("&joint name = 'j', type = 'sph|' /\n")
        self.assertEqual(found["spherical"].text_edit.new_text, "spherical")
        self.assertNotIn("bodies", found)
        found = await self.completed("&model name = 'm', axes = x-r| /\n")
        self.assertEqual(set(found), {"x-rear", "iso"})
        self.assertEqual(found["iso"].text_edit.new_text, "'iso'")
        self.assertEqual(set(await self.completed("&load name = 'l', follows = |")), {".true.", ".false."})

    async def test_names_of_the_open_deck_and_of_its_included_files_are_completed(self) -> None:
        (Path(self.folder.name) / "part.nml").write_text("&body name = 'carrier' /\n&point name = 'outer', at = 1, 2, 3 /\n")
        deck = "&include file = 'part.nml' /\n&body name = 'lca' /\n&point name = 'inner', at = 0, 0, 0 /\n&curve name = 'soft' /\n"
        found = await self.completed(deck + "&bushing bodies = 'chassis', 'l|'")
        self.assertEqual(set(found), {"lca", "carrier", "chassis"})
        self.assertEqual(set(await self.completed(deck + "&bushing name = 'b', at = '|")), {"inner", "outer"})
        found = await self.completed(deck + "&bushing name = 'b', curve = 'fx=-so|'")
        self.assertEqual(found["soft"].text_edit.range.end.character - found["soft"].text_edit.range.start.character, 2)
        self.assertEqual(await self.completed(deck + "! bodies = '|"), {})

    async def test_a_hover_gives_meaning_unit_and_default_of_keys_and_the_record_of_names(self) -> None:
        uri = self.open(AXLE.read_text(), AXLE)
        found = await self.hovered(uri, "         kt")
        for words in ("rates along the marker axes x, y, z", "3 numbers, at least 0", "unit: N/mm", "default: `0, 0, 0`"):
            self.assertIn(words, found)
        self.assertIn("the model: name, units", await self.hovered(uri, "&mod"))
        self.assertIn("&body name = 'lca'", await self.hovered(uri, "bodies = 'chassis', 'lc"))
        self.assertEqual(await self.hovered(uri, "! "), "")
        position = self.after("bodies = 'chassis', 'lc")
        place = await self.client.text_document_definition_async(lsp.DefinitionParams(lsp.TextDocumentIdentifier(uri), position))
        self.assertIn("&body name = 'lca'", self.text.split("\n")[place.range.start.line])

    async def test_every_key_of_every_group_has_a_hover(self) -> None:
        groups = [one for one in (await self.completed("|")).values()]
        self.assertGreater(len(groups), 20)
        for group in groups:
            keys = await self.completed(f"&{group.label} |")
            self.assertIn("note", keys)
            for key in keys.values():
                self.assertTrue(key.documentation.value.startswith(f"**{key.label}** of `&{group.label}`"))


class Starting(unittest.TestCase):
    def test_without_pygls_the_message_names_the_command_that_installs_it(self) -> None:
        words = "import sys; sys.modules['pygls'] = None; sys.modules['lsprotocol'] = None; from elastokin_command import serve; serve()"
        found = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True)
        self.assertEqual(found.returncode, 1)
        self.assertIn('pip install "elastokin[lsp]"', found.stderr)
        self.assertEqual(found.stderr.count("\n"), 1)


if __name__ == "__main__":
    unittest.main()

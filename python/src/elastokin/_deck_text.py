"""Records of a deck that may be unfinished, and the place of the cursor in it, for editors. Errors are found by `elastokin check`."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

_TOKEN = re.compile(
    r"""(?P<blank>\s+|![^\n]*)|(?P<string>'(?:[^'\n]|'')*'?|"(?:[^"\n]|"")*"?)|(?P<group>&\w*)|(?P<end>/)|(?P<equals>=)|(?P<comma>,)
    |(?P<subscript>\([^)\n]*\)?)|(?P<word>[^\s,/&'"=!()]+)|(?P<other>.)""",
    re.VERBOSE,
)
_MOST_NESTED = 8  # as in ek_deck


@dataclass
class Token:
    """A part of the text: its kind, the text and where it begins and ends."""

    kind: str
    text: str
    start: int
    end: int

    def is_closed(self) -> bool:
        """Whether a string has its closing quotation mark."""
        return len(self.text) > 1 and self.text[-1] == self.text[0]

    def content(self) -> str:
        """A string without quotation marks; another token as it is."""
        if self.kind != "string":
            return self.text
        quote = self.text[0]
        return self.text[1 : -1 if self.is_closed() else None].replace(quote * 2, quote)


@dataclass
class Entry:
    """A key of a record, with its values."""

    key: Token
    values: list[Token] = field(default_factory=list)

    def name(self) -> str:
        """The key in lower case."""
        return self.key.text.lower()


@dataclass
class Record:
    """A record: its group in lower case, its beginning and end in the text, and its keys."""

    group: str
    start: int
    end: int
    entries: list[Entry] = field(default_factory=list)
    path: Path | None = None  # the file; None: the text itself
    line: int = 0  # first line, from 0

    def value(self, key: str) -> str:
        """The first value of a key; '' if the key is not given."""
        for entry in self.entries:
            if entry.name() == key and entry.values:
                return entry.values[0].content()
        return ""


@dataclass
class Place:
    """The cursor: its record, the key whose value it is in or behind, and the part of a word or string to its left."""

    kind: str  # 'group', 'string', 'word', 'blank'; 'comment' where nothing is completed
    prefix: str = ""
    record: Record | None = None
    entry: Entry | None = None
    may_be_key: bool = False
    may_be_value: bool = False


def tokens_of(text: str) -> list[Token]:
    """All tokens of the text, blanks and comments included."""
    return [Token(str(found.lastgroup), found.group(), found.start(), found.end()) for found in _TOKEN.finditer(text)]


def records_of(text: str) -> list[Record]:
    """The records of a deck. A record without its end ends at the next group."""
    found: list[Record] = []
    record: Record | None = None
    tokens = [token for token in tokens_of(text) if token.kind != "blank"]
    for k, token in enumerate(tokens):
        if token.kind == "group":
            record = Record(token.text[1:].lower(), token.start, len(text), line=text.count("\n", 0, token.start))
            if found and found[-1].end == len(text):
                found[-1].end = token.start
            found.append(record)
        elif record is None:
            continue
        elif token.kind == "end":
            record.end = token.end
            record = None
        elif token.kind == "word" and _is_key(tokens, k):
            record.entries.append(Entry(token))
        elif token.kind in ("word", "string") and record.entries:
            record.entries[-1].values.append(token)
    return found


def _is_key(tokens: list[Token], k: int) -> bool:
    """Whether '=' or a subscript and '=' follow a word."""
    kinds = [token.kind for token in tokens[k + 1 : k + 3]]
    return kinds[:1] == ["equals"] or kinds == ["subscript", "equals"]


def place_at(text: str, offset: int) -> Place:
    """The place of the cursor before the character `offset`."""
    before = [token for token in tokens_of(text) if token.start < offset]
    record = next((one for one in records_of(text) if one.start < offset and (offset < one.end or one.end == len(text))), None)
    if record is not None and text[record.end - 1 : record.end] == "/" and offset >= record.end:
        record = None
    last = before[-1] if before else None
    place = Place("blank", record=record)
    if last is None:
        return place
    inside = text[last.start : offset]
    if record is not None:
        place.entry = next((one for one in reversed(record.entries) if one.key.end < offset), None)
    if last.kind == "blank" and inside.startswith("!"):
        place.kind = "comment"
    elif last.kind == "group" and offset <= last.end:
        place.kind, place.prefix, place.record = "group", inside[1:], None
    elif last.kind == "string" and (offset < last.end or not last.is_closed()):
        place.kind, place.prefix, place.may_be_value = "string", inside[1:], place.entry is not None
    else:
        if last.kind == "word" and offset <= last.end:
            place.kind, place.prefix = "word", inside
            before.pop()
        previous = next((token.kind for token in reversed(before) if token.kind != "blank"), "")
        place.may_be_value = place.entry is not None and previous in ("equals", "comma")
        place.may_be_key = record is not None and previous != "equals"
    return place


def with_included(text: str, path: Path, depth: int = 0) -> list[Record]:
    """The records of a deck and of the files that it includes, as far as they can be read."""
    found: list[Record] = []
    for record in records_of(text):
        found.append(record)
        part = included(record, path)
        if part is None or depth == _MOST_NESTED:
            continue
        try:
            inner = with_included(part.read_text("utf-8", "replace"), part, depth + 1)
        except OSError:
            continue
        for one in inner:
            one.path = one.path or part
        found += inner
    return found


def included(record: Record, path: Path) -> Path | None:
    """The file that a record of the deck `path` includes; None if the record is not &include."""
    name = record.value("file") if record.group == "include" else ""
    return path.parent / name if name else None

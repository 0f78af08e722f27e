#!/usr/bin/env python3
"""signatures.py FILE...: prints, as JSON, the signature of every function that WebAssembly objects or archives define.

A signature is RESULT(ARGUMENTS) with one letter per value: i for i32, l for i64, f for f32, d for f64. The names are those of the
section `linking`, which the linker uses. retarget.py compares them with the declarations of flang.
"""
import json
import sys
from pathlib import Path

letters = {0x7F: "i", 0x7E: "l", 0x7D: "f", 0x7C: "d", 0x7B: "v", 0x70: "r", 0x6F: "e"}
custom, types, imports, functions = 0, 1, 2, 3               # sections
symbol_table = 8                                             # subsection of `linking`
function, data, section = 0, 1, 3                            # kinds of symbols; others have the form of a function
undefined, explicit_name = 0x10, 0x40                        # flags of symbols


class Reader:
    """Numbers and names from the bytes of an object, one after the other."""

    def __init__(self, content):
        self.content = content
        self.at = 0

    def byte(self):
        self.at += 1
        return self.content[self.at - 1]

    def number(self):
        """An unsigned number in LEB128."""
        result = shift = 0
        while True:
            byte = self.byte()
            result |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return result

    def name(self):
        length = self.number()
        self.at += length
        return self.content[self.at - length : self.at].decode()

    def value_types(self):
        return "".join(letters[self.byte()] for _ in range(self.number()))

    def skip_limits(self):
        flags = self.byte()
        self.number()
        if flags & 1:
            self.number()


def read_types(reader):
    found = []
    for _ in range(reader.number()):
        reader.byte()                                        # 0x60, a function
        arguments = reader.value_types()
        found.append(f"{reader.value_types()}({arguments})")
    return found


def read_imports(reader):
    """(name, index of the type) of each imported function."""
    found = []
    for _ in range(reader.number()):
        reader.name()                                        # the module
        name, kind = reader.name(), reader.byte()
        if kind == 0:
            found.append((name, reader.number()))
        elif kind == 1:                                      # a table
            reader.byte()
            reader.skip_limits()
        elif kind == 2:                                      # a memory
            reader.skip_limits()
        elif kind == 3:                                      # a global
            reader.at += 2
        else:                                                # a tag
            reader.byte()
            reader.number()
    return found


def read_symbols(reader):
    """(index of the function, name) of each function that the symbol table defines."""
    for _ in range(reader.number()):
        kind, flags = reader.byte(), reader.number()
        if kind == data:
            reader.name()
            if not flags & undefined:
                for _ in range(3):
                    reader.number()
        elif kind == section:
            reader.number()
        else:
            index = reader.number()
            if not flags & undefined:
                name = reader.name()
                if kind == function:
                    yield index, name
            elif flags & explicit_name:
                reader.name()


def signatures_of(content):
    """Signatures by name, of one object."""
    reader = Reader(content)
    reader.at = 8                                            # after the magic number and the version
    known, indices, found = [], [], {}
    while reader.at < len(content):
        kind, size = reader.byte(), reader.number()
        end = reader.at + size
        if kind == types:
            known = read_types(reader)
        elif kind == imports:
            indices = [index for _, index in read_imports(reader)]
        elif kind == functions:
            indices += [reader.number() for _ in range(reader.number())]
        elif kind == custom and reader.name() == "linking":
            reader.number()                                  # its version
            while reader.at < end:
                subsection, size = reader.byte(), reader.number()
                next_one = reader.at + size
                if subsection == symbol_table:
                    found.update((name, known[indices[index]]) for index, name in read_symbols(reader))
                reader.at = next_one
        reader.at = end
    return found


def objects_of(path):
    """The contents of the WebAssembly objects of an archive, or of the object itself."""
    content = Path(path).read_bytes()
    if not content.startswith(b"!<arch>\n"):
        yield content
        return
    at = 8
    while at < len(content):
        size = int(content[at + 48 : at + 58])
        member = content[at + 60 : at + 60 + size]
        if member.startswith(b"\0asm"):
            yield member
        at += 60 + size + size % 2


if __name__ == "__main__":
    table = {}
    for path in sys.argv[1:]:
        for content in objects_of(path):
            table.update(signatures_of(content))
    json.dump(table, sys.stdout, indent=0, sort_keys=True)

"""Converts the LLVM IR that flang writes for x86-64 to IR for wasm32, for fortran.py.

flang 22 has no target with addresses of 32 bits. Its descriptors fit all the same: the integer of 64 bits behind an address begins
at a multiple of 8, so an address of 32 bits leaves four bytes unused. Converted are
  - target, data layout, and the attributes that name processors,
  - calls of procedures whose signature is another in wasm32 (std::size_t, c_size_t, malloc): each gets an adapter, which the
    optimiser puts in place of the call. The real signatures are those of the objects (signatures.py),
  - copies of memory with a length of 64 bits,
  - initial values of type(c_ptr) and type(c_funptr), which flang writes as integers of 64 bits,
  - temporary values of unknown size inside loops: flang requests stack for them in each pass and returns none before the end of the
    procedure. They get room that the next pass uses again (system/room.c),
  - the name of the main program.
Rejected is a derived type with a procedure pointer: its components would be elsewhere than where flang has them.
"""
import re

layout = "e-m:e-p:32:32-p10:8:8-p20:8:8-i64:64-i128:128-n32:64-S128-ni:1:10:20"
triple = "wasm32-unknown-wasi"
# letters as in signatures.py
letter = {"ptr": "i", "i1": "i", "i8": "i", "i16": "i", "i32": "i", "i64": "l", "float": "f", "double": "d", "void": ""}
type_of = {"i": "i32", "l": "i64", "f": "float", "d": "double", "": "void"}
adapter_prefix = "ek64."

processor = re.compile(
    r'"(?:target-cpu|target-features|tune-cpu|prefer-vector-width|min-legal-vector-width|frame-pointer)"="[^"]*"')
declaration = re.compile(r"declare (.*?)(\S+) @([\w.$]+)\((.*)\)")
descriptor = re.compile(r"\{ ptr, i64, i32, i8, i8, i8, i8(?:, \[\d+ x \[3 x i64\]\])?(?:, ptr, \[\d+ x i64\])? \}")
c_address = r"%_QM__fortran_builtinsT__builtin_c_(?:dev|fun|)ptr"


class Unsupported(Exception):
    """What cannot be converted, and why."""


def split_arguments(text):
    """The arguments of a declaration: a comma inside brackets separates nothing."""
    depth, word, found = 0, "", []
    for c in text:
        depth += (c in "({[<") - (c in ")}]>")
        if c == "," and depth == 0:
            found.append(word.strip())
            word = ""
        else:
            word += c
    return found + [word.strip()] if word.strip() else found


def adapter(name, result, arguments, signature):
    """(declaration with the real signature, definition of the adapter) of a procedure that flang declares with other types."""
    real_result, real_arguments = signature[:-1].split("(")
    lines, passed = [], []
    for k, (declared, real) in enumerate(zip(arguments, real_arguments)):
        if letter[declared] == real:
            passed.append(f"{declared} %a{k}")
        elif declared == "i64" and real == "i":
            lines.append(f"  %t{k} = trunc i64 %a{k} to i32")
            passed.append(f"i32 %t{k}")
        elif declared == "i32" and real == "l":
            lines.append(f"  %t{k} = sext i32 %a{k} to i64")
            passed.append(f"i64 %t{k}")
        else:
            raise Unsupported(f"{name} is declared with {arguments}, but is {signature}")
    returned = result if letter[result] == real_result else type_of[real_result]
    call = f"call {returned} @{name}({', '.join(passed)})"
    widths = {("i64", "i32"): "sext", ("i32", "i64"): "trunc"}
    if result == "void":
        lines += [f"  {call}" if returned == "void" else f"  %r = {call}", "  ret void"]
    elif returned == result:
        lines += [f"  %r = {call}", f"  ret {result} %r"]
    elif (result, returned) in widths:
        lines += [f"  %r = {call}", f"  %s = {widths[result, returned]} {returned} %r to {result}", f"  ret {result} %s"]
    else:
        raise Unsupported(f"{name} is declared as {result}, but is {signature}")
    named = ", ".join(f"{a} %a{k}" for k, a in enumerate(arguments))
    head = f"define internal {result} @{adapter_prefix}{name}({named}) alwaysinline {{"
    return f"declare {returned} @{name}({', '.join(p.split()[0] for p in passed)})", "\n".join([head, *lines, "}"])


def set_target(text):
    text = re.sub(r"(?m)^target datalayout = .*$", f'target datalayout = "{layout}"', text, count=1)
    text = re.sub(r"(?m)^target triple = .*$", f'target triple = "{triple}"', text, count=1)
    text = re.sub(r"(?m)^attributes #\d+ = \{.*$", lambda m: processor.sub("", m.group()), text)
    return re.sub(r"(?m)^(attributes #\d+ = \{)\s*\}", r"\1 nounwind }", text)


def place_addresses(text):
    """Initial values of c_ptr and c_funptr: an address of 32 bits and a zero in place of an integer of 64 bits."""
    text = re.sub(rf"(?m)^({c_address} = type \{{) i64 \}}", r"\1 ptr, i32, [0 x i64] }", text)
    text = re.sub(rf'({c_address}) \{{ i64 ptrtoint \(ptr (@[\w.$]+|@"[^"]+") to i64\) \}}',
                  r"\1 { ptr \2, i32 0, [0 x i64] zeroinitializer }", text)
    text = re.sub(rf"({c_address}) \{{ i64 (?:0|undef) \}}", r"\1 zeroinitializer", text)
    return re.sub(rf"({c_address}) \{{ i64 (\d+) \}}",
                  r"\1 { ptr inttoptr (i64 \2 to ptr), i32 0, [0 x i64] zeroinitializer }", text)


def reject_procedure_pointers(text):
    for found in re.finditer(r"(?m)^%(_Q\S+) = type (\{.*\})$", text):
        if "__builtin_c_" not in found.group(1) and re.search(r"\bptr\b", descriptor.sub("", found.group(2))):
            raise Unsupported(f"type {found.group(1)} has a procedure pointer, or another address outside a descriptor")


def is_in_loop(name, successors):
    """Whether the block of that name can be reached from itself."""
    reached, to_see = set(), [name]
    while to_see:
        for block in successors.get(to_see.pop(), ()):
            if block == name:
                return True
            if block not in reached:
                reached.add(block)
                to_see.append(block)
    return False


def reuse_room(lines):
    """The lines of one procedure, in which temporary values of unknown size inside loops use room that is requested once."""
    temporary = re.compile(r"  (%\S+) = alloca ([^,]+), i64 (%[^,]+)(?:,|$)")
    sites = [k for k, line in enumerate(lines) if temporary.match(line)]
    if not sites:
        return lines
    block, block_of, successors = "entry", {}, {}
    for k, line in enumerate(lines):
        if found := re.match(r'([-\w$.]+|"[^"]+"):', line):
            block = found.group(1)
        block_of[k] = block
        successors.setdefault(block, set()).update(re.findall(r"label %([-\w$.]+|\"[^\"]+\")", line))
    sites = [k for k in sites if is_in_loop(block_of[k], successors)]
    if not sites:
        return lines
    slots = [f"%ek.slot{k}" for k in sites]
    begin = [text for slot in slots for text in (f"  {slot} = alloca ptr, align 4", f"  store ptr null, ptr {slot}, align 4")]
    end = []
    for k, slot in zip(sites, slots):
        end += [f"  %ek.last{k}.@ = load ptr, ptr {slot}, align 4", f"  call void @ek_release_room(ptr %ek.last{k}.@)"]
    result = [lines[0], *begin]
    for k, line in enumerate(lines[1:], 1):
        if k in sites:
            name, kind, count = temporary.match(line).groups()
            slot = slots[sites.index(k)]
            result += [f"  %ek.old{k} = load ptr, ptr {slot}, align 4",
                       f"  %ek.size{k} = mul i64 {count}, ptrtoint (ptr getelementptr ({kind}, ptr null, i32 1) to i64)",
                       f"  {name} = call ptr @ek_renew_room(ptr %ek.old{k}, i64 %ek.size{k})",
                       f"  store ptr {name}, ptr {slot}, align 4"]
            continue
        if line.startswith("  ret "):
            result += [text.replace("@", str(k), 1) if " = load" in text else text.replace(".@)", f".{k})") for text in end]
        result.append(line)
    return result


def reuse_rooms(lines):
    """As reuse_room, for every procedure; declares what they call."""
    result, begin = [], None
    for k, line in enumerate(lines):
        if line.startswith("define "):
            begin = k
        if begin is None:
            result.append(line)
        elif line == "}":
            result += reuse_room(lines[begin : k + 1])
            begin = None
    if any("@ek_renew_room(" in line for line in result):
        result += ["declare ptr @ek_renew_room(ptr, i64)", "declare void @ek_release_room(ptr)"]
    return result


def adapt_calls(lines, signatures):
    """(definitions of adapters, names of the adapted procedures); the declarations in `lines` become the real ones."""
    definitions, names = [], []
    for k, line in enumerate(lines):
        found = declaration.match(line)
        if not found or found.group(3).startswith("llvm."):
            continue
        result, name = found.group(2), found.group(3)
        arguments = [a.split()[0] for a in split_arguments(found.group(4)) if a != "..."]
        if name not in signatures or any(a not in letter for a in [result, *arguments]):
            continue
        signature = signatures[name]
        # after the arguments of a procedure of C, flang passes the lengths of strings, which C does not receive
        count = len(signature[:-1].split("(")[1])
        if len(arguments) < count or any(a != "i64" for a in arguments[count:]):
            raise Unsupported(f"{name} is declared with {arguments}, but is {signature}")
        if f"{letter[result]}({''.join(letter[a] for a in arguments)})" != signature:
            lines[k], definition = adapter(name, result, arguments, signature)
            definitions.append(definition)
            names.append(name)
    return definitions, names


def adapt_copies(lines):
    """As adapt_calls, for memcpy, memmove and memset with a length of 64 bits."""
    definitions, names = [], []
    for old, second in (("llvm.memcpy.p0.p0.i64", "ptr"), ("llvm.memmove.p0.p0.i64", "ptr"), ("llvm.memset.p0.i64", "i8")):
        new = old.replace("i64", "i32")
        if not any(f"@{old}(" in line for line in lines):
            continue
        lines[:] = [x for x in lines if not (x.startswith("declare") and (f"@{old}(" in x or f"@{new}(" in x))]
        definitions.append(f"""declare void @{new}(ptr, {second}, i32, i1 immarg)
define internal void @{adapter_prefix}{old}(ptr %a, {second} %b, i64 %n, i1 %v) alwaysinline {{
  %t = trunc i64 %n to i32
  call void @{new}(ptr %a, {second} %b, i32 %t, i1 false)
  ret void
}}""")
        names.append(old)
    return definitions, names


def retarget(text, signatures):
    """The IR `text` for wasm32. `signatures`: those of the C library, the Fortran runtime and elastokin_system.c, by name."""
    text = place_addresses(set_target(text)).replace("@main(", "@ek_fortran_main(")
    reject_procedure_pointers(text)
    lines = reuse_rooms(text.split("\n"))
    definitions, names = [], []
    for part in (adapt_calls(lines, signatures), adapt_copies(lines)):
        definitions += part[0]
        names += part[1]
    if names:
        called = re.compile(rf"(?<=@)({'|'.join(re.escape(n) for n in sorted(names, key=len, reverse=True))})(?=\()")
        lines = [x if x.startswith("declare") else called.sub(rf"{adapter_prefix}\1", x) for x in lines]
    return "\n".join(lines + definitions) + "\n"

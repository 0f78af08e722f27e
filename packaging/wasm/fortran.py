#!/usr/bin/env python3
"""fortran.py OPTION... FILE...: a Fortran compiler and linker for wasm32-wasi, in the form that CMake uses (toolchain.cmake).

flang translates for x86-64 without optimising, retarget.py converts that to wasm32, and clang optimises and compiles it.
EK_WASM_RUNTIME names a folder that tools/wasm.sh fills: Fortran runtime, functions of the system, entry, signatures. With
EK_WASM_KEEP=1 the intermediate files stay in the folder of the object.
"""
import json
import os
import subprocess
import sys
from pathlib import Path

from retarget import Unsupported, retarget

# not optimised here: what flang would do is right for x86-64 only
flang = ["flang-22", "--target=x86_64-linux-gnu", "-mllvm", "-opt-bisect-limit=0", "-mllvm", "-opt-bisect-verbose=0"]
clang = ["clang-22", "--target=wasm32-wasi", "-w"]
# clang would call a wasm-opt of any version that it finds
link = ["clang++-22", "--target=wasm32-wasi", "-w", "--no-wasm-opt", "-nostartfiles"]
emulated = ["-lwasi-emulated-getpid", "-lwasi-emulated-signal", "-lwasi-emulated-process-clocks"]
# a signature that does not fit is an error, and a stack that is full a trap, not other data
strict = ["-Wl,-z,stack-size=8388608", "-Wl,--stack-first", "-Wl,--fatal-warnings"]
levels = ("-O0", "-O1", "-O2", "-O3")


class Arguments:
    """The command line."""

    def __init__(self, words):
        self.for_flang, self.for_clang, self.for_link, self.sources = [], [], [], []
        self.level, self.output, self.only_compile, self.only_flang = "-O2", None, False, False
        words = iter(words)
        for word in words:
            if word == "-o":
                self.output = next(words)
            elif word == "-c":
                self.only_compile = True
            elif word in ("-J", "-I", "-module-dir"):
                self.for_flang += [word, next(words)]
            elif word.startswith("-module-dir"):
                self.for_flang += ["-module-dir", word.removeprefix("-module-dir")]
            elif word in levels:
                self.level = word
            elif word.startswith("-m"):
                self.for_clang.append(word)
            elif word.startswith(("-L", "-l", "-Wl,")) or word.endswith((".o", ".a", ".obj")):
                self.for_link.append(word)
            elif Path(word).suffix.lower() in (".f90", ".f"):
                self.sources.append(word)
            elif word in ("-E", "-v", "--version"):
                self.only_flang = True
            elif word in ("-cpp", "-ffixed-form") or word.startswith(("-I", "-J", "-D", "-U")):
                self.for_flang.append(word)


def run(*words):
    subprocess.run(words, check=True)


def compile_file(arguments, source, target, signatures):
    x86, wasm = Path(f"{target}.x86.ll"), Path(f"{target}.wasm.ll")
    run(*flang, arguments.level, *arguments.for_flang, "-S", "-emit-llvm", source, "-o", str(x86))
    try:
        wasm.write_text(retarget(x86.read_text(), signatures))
        run(*clang, arguments.level, *arguments.for_clang, "-c", "-x", "ir", str(wasm), "-o", target)
    except Unsupported as reason:
        sys.exit(f"{source}: cannot be compiled for WebAssembly: {reason}")
    finally:
        if not os.environ.get("EK_WASM_KEEP"):
            x86.unlink()
            wasm.unlink(missing_ok=True)


def main(words):
    arguments = Arguments(words)
    if arguments.only_flang:
        sys.exit(subprocess.run(["flang-22", *words], check=False).returncode)
    if "EK_WASM_RUNTIME" not in os.environ:
        sys.exit("fortran.py: EK_WASM_RUNTIME is not set; tools/wasm.sh sets it and calls CMake")
    runtime = Path(os.environ["EK_WASM_RUNTIME"])
    signatures = json.loads((runtime / "signatures.json").read_text())
    objects = []
    for source in arguments.sources:
        if arguments.only_compile:
            target = arguments.output or Path(source).stem + ".o"
        else:
            target = f"{arguments.output or 'a.out'}.{Path(source).name}.o"
        compile_file(arguments, source, target, signatures)
        objects.append(target)
    if not arguments.only_compile:
        own = [str(runtime / name) for name in ("entry.o", "missing.o", "room.o", "libfortran_runtime.a")]
        run(*link, *objects, *arguments.for_link, *own, *emulated, *strict, "-o", arguments.output or "a.out")


try:
    main(sys.argv[1:])
except subprocess.CalledProcessError as error:
    sys.exit(error.returncode if error.returncode > 0 else 1)

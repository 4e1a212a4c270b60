"""What a page of a firm's templates must not do: run, fetch, or lose the policy that forbids it. Judged on what a browser reads.

The page is parsed by the HTML5 algorithm and its styles by CSS Syntax, so that neither escapes nor misplaced tags hide an address.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import Any

from diecut_report.errors import Problem, UserError
from diecut_report.text.phrases import Phrase, phrase

HTML = "http://www.w3.org/1999/xhtml"
RUNNING = {
    "script", "iframe", "frame", "frameset", "link", "object", "embed", "applet", "portal", "base", "animate", "set", "noscript", "template",
}  # fmt: skip
"""Elements that run, embed, change addresses, or are read otherwise where scripts are off."""
ADDRESSES = {
    "src", "srcset", "data", "poster", "background", "href", "imagesrcset", "action", "formaction", "ping", "manifest", "longdesc", "lowsrc",
    "dynsrc", "codebase", "archive", "classid", "icon", "profile",
}  # fmt: skip
SETS = {"srcset", "imagesrcset"}
"""Attributes that hold many addresses, of which each screen takes another."""
LINKS = re.compile(r"(https?:|mailto:|tel:|data:|#)", re.IGNORECASE)
"""What a link may lead to: nothing is fetched before a reader follows it."""
FETCHING_FUNCTIONS = {
    "url", "src", "image", "image-set", "-webkit-image-set", "cross-fade", "-webkit-cross-fade", "element", "attr",
}  # fmt: skip
_RISKY = re.compile(rf"<({'|'.join(sorted(RUNNING | {'meta', 'form'}))})(?![\w-])", re.IGNORECASE)
"""The begin of an element that runs, embeds or leads elsewhere, wherever in the page it stands."""
_UNWRITTEN = re.compile("[\0-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")  # characters that no page may hold


def refuse_fetching(page: str, folder: str, policy: str, main: str) -> None:
    """Raise UserError for a page that would fetch or run something, that lost its policy, or holds characters which none may hold.

    ``policy`` is what a browser is to obey; a page that is only printed has none. ``main`` is the template that holds it.
    """
    from tinyhtml5 import parse

    tree: Any = parse(page)
    advice = phrase('a report fetches nothing. Put pictures into the folder and write {{ picture("NAME") }}.')
    fetched = dict.fromkeys(_fetched(tree))
    found = [Phrase("{each} would be fetched; {advice}", each=each, advice=advice) for each in fetched]
    if policy and not _is_protected(tree, policy):
        words = Phrase("The page has lost its Content-Security-Policy. Override blocks of {main}, not the whole of it, "
                       "or keep its head.", main=main)  # fmt: skip
        found.append(words)
    found += [
        Phrase("<{tag} stands in a text, where some browsers take it for an element. Write &lt;{tag} there.", tag=tag)
        for tag in _hidden(page, tree)
    ]
    if letter := _UNWRITTEN.search(page):
        code = format(ord(letter[0]), "04X")
        found.append(Phrase("A template writes U+{code}, which a page cannot hold. Leave it out.", code=code))
    if found:
        raise UserError([Problem(words, folder) for words in found])


def _hidden(page: str, tree: Any) -> list[str]:
    """The risky elements of which the page holds more than its tree: those in a text, a comment or an attribute.

    No parser reads every page as every browser does: what stands there for one of them may be an element for another.
    """
    written = Counter(match[1].lower() for match in _RISKY.finditer(page))
    read = Counter(str(each.tag) for each in tree.iter())
    return [tag for tag, count in written.items() if count > read[f"{{{HTML}}}{tag}"]]


def _is_protected(tree: Any, policy: str) -> bool:
    """Return whether the page has this policy alone, at the begin of its head, behind its encoding, in which it was judged."""
    of_policy = [
        each for each in tree.iter(f"{{{HTML}}}meta") if _lower(each, "http-equiv") == "content-security-policy"
    ]
    head = tree.find(f"{{{HTML}}}head")
    first = [] if head is None else [each for each in head if isinstance(each.tag, str)][:2]
    is_first = len(first) == 2 and _lower(first[0], "charset") == "utf-8" and [first[1]] == of_policy
    return is_first and first[1].get("content") == policy


def _lower(element: Any, name: str) -> str:
    return str(element.get(name, "")).strip().lower()


def _fetched(tree: Any) -> Iterator[str]:
    for element in tree.iter():
        if not isinstance(element.tag, str):
            continue  # a comment
        tag = element.tag.rpartition("}")[2]
        if tag.lower() in RUNNING or (tag == "meta" and _lower(element, "http-equiv") == "refresh"):
            address = element.get("src") or element.get("href") or element.get("data") or _lower(element, "http-equiv")
            yield f"<{tag}> {address[:80]}".rstrip()
        if tag == "style":
            yield from (what for what, _ in fetched_by_css("".join(element.itertext())))
        for name, value in element.attrib.items():
            yield from _fetched_by_attribute(tag, name.rpartition("}")[2].lower(), value)


def _fetched_by_attribute(tag: str, name: str, value: str) -> Iterator[str]:
    address = value.strip().lower()
    is_outside = name in SETS or not address.startswith(("data:", "#"))
    if name.startswith("on"):
        yield f"<{tag} {name}>"
    elif name == "rel" and "attachment" in address.split():
        yield f"<{tag} rel={value[:80]}>"  # into the sheets, beside what the program carries there
    elif name in ("href", "xlink:href") and tag.lower() in ("a", "area"):
        if not LINKS.match(re.sub(r"[\s\0-\x1f]", "", address)):
            yield f"<{tag}> {value[:80]}"
    elif name.removeprefix("xlink:") in ADDRESSES and address and is_outside:
        yield f"<{tag}> {value[:80]}"
    if name == "style" or "(" in value:
        yield from (what for what, _ in fetched_by_css(value))


def fetched_by_css(css: str) -> Iterator[tuple[str, int]]:
    """Yield what a style would fetch, with its line."""
    import tinycss2

    yield from _fetched_by_tokens(tinycss2.parse_component_value_list(css, skip_comments=True))


def _fetched_by_tokens(every: Iterable[Any]) -> Iterator[tuple[str, int]]:
    """What tokens would fetch, however deep they lie in each other."""
    open_lists: list[tuple[Iterator[Any], str]] = [(iter(every), "")]
    while open_lists:
        tokens, within = open_lists[-1]
        token = next(tokens, None)
        if token is None:
            open_lists.pop()
        elif token.type == "at-keyword" and token.lower_value == "import":
            yield "@import", token.source_line
        elif token.type == "url" or (token.type == "string" and within):
            if not token.value.strip().lower().startswith(("data:", "#")):
                yield f"{within or 'url'}({token.value[:60]}", token.source_line
        elif token.type == "function":
            name = token.lower_name if token.lower_name in FETCHING_FUNCTIONS else within
            open_lists.append((iter(token.arguments), name))
        else:
            open_lists.append((iter(getattr(token, "content", None) or ()), within))

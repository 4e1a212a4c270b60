"""``check-plugin`` tries each rule of the contract, and tells what is wrong with file and line."""

from __future__ import annotations

import json
import re
from codecs import BOM_UTF8
from collections.abc import Callable
from pathlib import Path

import pytest

from diecut_report.cli.main import main
from diecut_report.config.loader import load_config
from diecut_report.config.plugins import Discovery
from diecut_report.errors import UserError
from diecut_report.testing import extreme_inputs
from diecut_report.testing.contract import TITLES, ContractTest, check_contract, write_missing
from diecut_report.testing.plugin_page import meant
from diecut_report.testing.scaffold import contents
from diecut_report.text.catalogues import catalogue
from diecut_report.text.po_files import changed, read
from tests.configs import BROKEN, SMALL, saved
from tests.examples import few

Capture = pytest.CaptureFixture[str]
SOUND = contents("toggle", as_package=False)


def toggle(folder: Path, *changes: tuple[str, str]) -> Path:
    """The project of a new mechanism with changes in its plugin."""
    for place, content in SOUND.items():
        file = folder / "toggle" / place
        file.parent.mkdir(parents=True, exist_ok=True)
        for old, new in changes if file.name == "toggle.py" else ():
            assert old in content
            content = content.replace(old, new)
        file.write_text(content, "utf-8")
    return folder / "toggle"


def contract(folder: Path, *changes: tuple[str, str]) -> ContractTest:
    """The contract test of a mechanism with changes."""
    home = toggle(folder, *changes)
    known = Discovery([home / "plugins"])
    config = load_config(home / "examples" / "toggle.yaml", known)
    return ContractTest(known.mechanism("toggle"), known, config, "toggle")


@pytest.mark.wheel
def test_a_sound_plugin_holds_all_rules_and_is_shown(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    home = toggle(tmp_path)
    monkeypatch.chdir(home)
    assert main(["check-plugin", "toggle", "--plugins", "plugins", "--language", "uk"]) == 0
    told = capfd.readouterr()
    lines = told.out.splitlines()
    assert lines[0] == "toggle 0.1, з plugins/toggle.py" and len(lines) == 1 + len(TITLES)
    assert all(line.startswith("  дотримано  ") for line in lines[1:]) and "Приклад машини: " in told.out
    assert told.err.startswith("-o FILE ") and not (home / "toggle.html").exists()


@pytest.mark.nightly
def test_its_chapter_is_written_where_it_is_asked_for_and_nowhere_else(
    tmp_path: Path, capfd: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    home, shown = toggle(tmp_path), list[str]()
    monkeypatch.chdir(home)
    monkeypatch.setattr("webbrowser.open", shown.append)
    monkeypatch.setattr("diecut_report.cli.plugins.mkdtemp", lambda prefix: str(tmp_path))
    before = sorted(home.rglob("*.html"))
    (home / "build").mkdir()
    one = ["check-plugin", "toggle", "--plugins", "plugins", "--language", "uk"]
    assert main([*one, "-o", "chapter.html"]) == main([*one, "-o", "build"]) == main([*one, "--open"]) == 0
    assert capfd.readouterr().err.splitlines() == [
        "записано: chapter.html", "записано: build/toggle.html", f"записано: {tmp_path / 'toggle.html'}",
    ]  # fmt: skip
    page = (home / "chapter.html").read_text("utf-8")
    assert "Пружини виштовхувача" in page and "Характеристика" in page
    assert shown == [(tmp_path / "toggle.html").as_uri()]
    assert sorted(home.rglob("*.html")) == sorted([*before, home / "chapter.html", home / "build" / "toggle.html"])


@pytest.mark.nightly
def test_a_plugin_is_tried_on_all_machines_of_its_kind(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path)
    example = home / "examples" / "toggle.yaml"
    second = example.read_text("utf-8").replace("\n  toggle:\n", "\n  second:\n")
    (home / "examples" / "zweig.yaml").write_text(second, "utf-8")
    assert main(["check-plugin", str(home)]) == 0
    out = capfd.readouterr().out
    assert re.search(r"Example machine: \S*toggle.yaml, mechanism toggle; \S*zweig.yaml, mechanism second\n", out)
    assert "Figures and report: 1 figure; on 1 other machine too" in out
    home = toggle(tmp_path / "odd", *odd("assert np.all(travel != 0.011)\n    return travel * 1e5"))
    (home / "examples" / "zweig.yaml").write_text(second.replace("travel: 10 mm", "travel: 11 mm"), "utf-8")
    assert main(["check-plugin", str(home)]) == 3
    assert re.search(r"broke  Example machine: .*\n +\S*zweig.yaml, mechanism second: ", capfd.readouterr().out)


CALLS = (
    "    total,\n",
    "    total, computed, pick, standard_series,\n",
)  # on one line, so that all others keep their numbers


def odd(body: str) -> tuple[tuple[str, str], ...]:
    """Changes that add a quantity by plain code."""
    head, total = 'EN_13906 = "EN 13906-1"\n', "springs.rate = total("
    computed = 'springs.odd = computed(odd, ("travel",), "in words"), "o", "N", "Odd"\n'
    return (total, f"{computed}{total}"), (head, f"{head}\n\ndef odd(travel):\n    {body}\n\n"), CALLS


TOO_SOFT = ("wire**4 / (8", "wire**3 / (8")
MISTAKES = {  # the rule, what it finds, the changes of the plugin, and what is told
    "dimensions": ("dimensions", "fail", (TOO_SOFT,), r"toggle.py:57: spring_rate: .*gives Pa, declared is N/m"),
    "an input that nothing takes": (
        "inputs", "fail", (("    # A limit", '    spare = Quantity("z", "mm", "Spare", default=1)\n    # A limit'),),
        r"toggle.py:\d+: input spare: nothing uses it",
    ),
    "a figure": (
        "figures", "fail", (('view["travel"], 25', 'view["trvel"], 25'),), r"toggle.py:\d+: characteristic: .*there is no number 'trvel'",
    ),
    "another machine among others": (
        "alone", "fail", odd("return travel * 1e5 * len(travel)"), r"toggle.py:\d+: odd: is \S+ in a batch, \S+ on its own",
    ),
    "no arrays": (
        "alone", "note", odd("return travel.item() * 1e5"),
        "does not support arrays, so that a study calculates it variant by variant: ValueError",
    ),
    "an extreme value": (
        "hostile", "fail", odd("return {True: travel}[bool((travel < 1.0).all())] * 1e5"),
        r"toggle.py:43: travel: with 100000: the plugin breaks: .*KeyError: False \(toggle.py:55\)",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MISTAKES)
def test_a_mistake_is_told_with_its_rule_file_and_line(tmp_path: Path, name: str) -> None:
    rule, status, changes, told = MISTAKES[name]
    tried = contract(tmp_path, *changes).tried_alone(rule)
    assert tried.status == status
    assert any(re.search(told, fault) for fault in tried.faults), tried.faults


KEPT = """if "travel" not in KNOWN:
        KNOWN["travel"] = travel.max()
    return KNOWN["travel"] * 1e5 * np.ones_like(travel)


KNOWN = {}"""
UNLIKE = {
    "kept between two calls": odd(KEPT),
    "an order of texts": odd(
        'return travel * 1e5 * (1 + 1e-9 * list({"right", "left", "middle", "upper"}).index("left"))'
    ),
}


@pytest.mark.nightly
@pytest.mark.parametrize("name", few(UNLIKE, keep=lambda name: name == "kept between two calls"))
def test_what_differs_between_new_processes_is_told(tmp_path: Path, name: str) -> None:
    test = contract(tmp_path, *UNLIKE[name])
    assert test.tried_alone("example").status == "pass"
    tried = test.tried_alone("again")
    assert tried.status == "fail"
    words = r"toggle.py:\d+: odd: differs between two new processes, one of which calculates another machine first \(\[.*\], \[.*\]\): equal inputs"
    assert re.match(words, tried.faults[0]), tried.faults


@pytest.mark.nightly
def test_a_figure_that_differs_between_new_processes_is_told(tmp_path: Path) -> None:
    change = ('view["travel"], 25', 'view["travel"] * (1 + 1e-9 * getattr(np.random, "ra" + "nd")()), 25')
    tried = contract(tmp_path, change).tried_alone("again")
    assert tried.status == "fail" and re.match(r"toggle.py:\d+: characteristic: differs", tried.faults[0]), tried.faults


@pytest.mark.nightly
def test_a_plugin_that_breaks_in_a_new_process_is_told(tmp_path: Path) -> None:
    gone = contract(tmp_path)
    (tmp_path / "toggle" / "plugins" / "toggle.py").write_text("1 / 0", "utf-8")
    (fault,) = gone.tried_alone("again").faults
    assert "cannot be calculated in a new process: " in fault and "ZeroDivisionError" in fault


def test_notes_of_a_check_stand_at_its_own_line(tmp_path: Path) -> None:
    """A step has the same id here; it stands elsewhere."""
    test = contract(tmp_path, ("m.allowable_stress,", "1e9,"))
    lines = (tmp_path / "toggle" / "plugins" / "toggle.py").read_text("utf-8").splitlines()
    line = lines.index("        Check(") + 1
    (note,) = test.tried_alone("verdicts").faults
    assert note.startswith(f"toggle.py:{line}: stress: passes in all 400 machines")


@pytest.mark.parametrize(("way", "found"), [("down", []), ("up", ["stress"])])
def test_keys_whose_change_never_helps_are_noted(tmp_path: Path, way: str, found: list[str]) -> None:
    advised = ("            consequence=", f'            advise=(Vary("travel", "{way}"),),\n            consequence=')
    tried = contract(tmp_path, advised, ("    View,\n", "    Vary,\n    View,\n")).tried_alone("advice")
    assert tried.status == ("note" if found else "pass")
    assert [fault.split(": ")[1] for fault in tried.faults] == found


def test_a_demand_below_zero_that_is_great_in_size_is_noted(tmp_path: Path) -> None:
    tried = contract(tmp_path, *odd("return -travel * 1e5"), SIGNED).tried_alone("verdicts")
    _, note = [fault for fault in tried.faults if ": far: " in fault]  # it passes in all machines, too
    assert tried.status == "note"
    assert (
        "passes with -1000 N, in size beyond the limit 40 N: if the direction does not count, compare the absolute value"
        in note
    )


SIGNED = (
    "    checks=(\n",
    '    checks=(\n        Check("far", "strength", "Far", "odd", 40, consequence="c"),\n',
)


CANCELLED = "return (np.sin(1e6 * travel) ** 2 + np.cos(1e6 * travel) ** 2) * 1e9 - 1e9"


def test_what_rounding_leaves_of_numbers_that_cancel_is_no_difference(tmp_path: Path) -> None:
    """Arrays are rounded otherwise than single numbers: here by a share of the whole, of which nothing is left."""
    other = CANCELLED.replace("1e9 - 1e9", "1e9 * (1 + 3e-17 * len(travel)) - 1e9")  # by 4e-7 among others
    assert contract(tmp_path / "same", *odd(CANCELLED)).tried_alone("alone").status == "pass"
    assert contract(tmp_path / "more", *odd(other)).tried_alone("alone").status == "pass"
    assert contract(tmp_path / "else", *odd(f"{CANCELLED} + len(travel)")).tried_alone("alone").status == "fail"


def test_a_machine_beside_the_example_may_be_refused(tmp_path: Path) -> None:
    """By plain code too, which refuses all of many for one of them."""
    body = 'if (travel > {limit}).any():\n        raise Refusal("travel", "is too long")\n    return {gives} * 1e5'
    for gives in ("travel", "travel.item()"):
        changes = (
            *odd(body.format(limit=0.01005, gives=gives)),
            ("import numpy as np", "import numpy as np\n\nfrom diecut_report.api import Refusal"),
        )
        test = contract(tmp_path / gives, *changes)
        assert test.tried_alone("alone").status == "note" and test.tried_alone("speed").status == "pass"


PICKED = (  # a size of a series by the travel, and what is wrong among others as soon as they have another size
    "springs.rate = total(",
    'springs.wire_size = pick("above", of="travel", series=(8, 12.5, 20, 40)), "d_n", "mm", "Size"\n'
    'springs.odd = computed(odd, ("wire_size",), "in words"), "o", "mm", "Odd"\nsprings.rate = total(',
)


def test_machines_are_tried_together_where_they_take_other_values_of_a_series(tmp_path: Path) -> None:
    test = contract(tmp_path, PICKED, *odd("return wire_size * (1 + wire_size.std())")[1:], PICKED_NAMES)
    tried = test.tried_alone("alone")
    assert tried.status == "fail" and "1 of 1 picks change" in tried.summary
    assert any(re.search(r"odd: is \S+ .*in a batch, \S+ .*on its own", fault) for fault in tried.faults), tried.faults


PICKED_NAMES = ("def odd(travel)", "def odd(wire_size)")


def test_warnings_of_numpy_are_not_told(tmp_path: Path) -> None:
    """Here a warning is an error, so that the rule would break."""
    test = contract(tmp_path, *odd("return travel + 0 * (np.nanmax(np.full(2, np.nan)) > 0)"))
    assert [test.tried_alone(rule).status for rule in ("example", "alone")] == ["pass", "pass"]


def test_each_list_is_tried_as_an_empty_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tried = list[str]()
    monkeypatch.setattr("diecut_report.testing.extreme_inputs.EXTREMES", 2)
    monkeypatch.setattr(
        extreme_inputs, "outcome_of", lambda text, *_: tried.append(text) or extreme_inputs.Outcome(None)
    )
    contract(tmp_path).tried_alone("hostile")
    assert [json.loads(text)["mechanisms"]["toggle"]["springs"] for text in tried].count([]) == 1 and len(tried) == 3


def test_a_text_that_a_lambda_makes_is_one_of_the_plugin(tmp_path: Path) -> None:
    template = 'springs.words("more", lambda rate: Phrase("make it {rate}", rate=rate), takes=("rate",))\n'
    home = contract(
        tmp_path, ("strength = Chapter", f"{template}strength = Chapter"), ("    Mechanism,\n", "    Mechanism,\n    Phrase,\n"),
        ('consequence="', 'consequence="{more}; '), ("yields; a thinner wire", "yields")
    )  # fmt: skip
    assert any(
        "“make it {rate}” (toggle.py) is not translated" in fault for fault in home.tried_alone("languages").faults
    )


@pytest.mark.nightly
def test_the_texts_that_a_catalogue_lacks_are_written_into_it(tmp_path: Path, capfd: Capture) -> None:
    change = ('title="Springs of an ejector"', 'title="Springs that eject"')
    home = toggle(tmp_path, change)
    (home / "plugins" / "_old.py").write_text(
        'KEPT = "Springs of an ejector"\n', "utf-8"
    )  # so that nothing is obsolete
    file, page = home / "plugins" / "toggle.uk.po", ("-o", str(tmp_path / "page.html"))
    before = file.read_text("utf-8")
    assert main(["check-plugin", str(home), "--write-po", *page]) == 0
    told = capfd.readouterr()
    assert f"written: {file}: 1 text to be translated" in told.err
    assert file.read_text("utf-8") == f'{before.rstrip()}\n\n#. mechanism\nmsgid "Springs that eject"\nmsgstr ""\n\n'
    known = Discovery([home / "plugins"])
    test, origin = ContractTest(known.mechanism("toggle"), known), known.origins["toggle"][0]
    assert write_missing(test, origin) == {}  # what waits already is not written twice
    file.unlink()
    catalogue.cache_clear()
    assert list(write_missing(test, origin)) == [file]
    assert 'msgid "Diameter of the wire"\nmsgstr ""' in file.read_text("utf-8")
    assert all(not message.string for message in read(file, "uk") if message.id)


FORMER = b'\n#~| msgid "older"\n#~ msgid "old"\n#~ msgstr "\xd1\x81\xd1\x82"\n'


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda text: BOM_UTF8 + text, ""),
        (lambda text: text + FORMER, ""),
        (lambda text: text.decode().encode("cp1251", "replace"), "cannot be read"),
        (lambda text: text.replace(b"msgid", b"msgidd", 1), "cannot be read"),
        (lambda text: text.replace(b"charset=utf-8", b"charset=CHARSET"), "cannot be read"),
    ],
    ids=["mark", "former", "other letters", "misspelt", "placeholder"],
)
def test_a_catalogue_that_cannot_be_read_is_told_and_stays(
    spoil: Callable[[bytes], bytes], told: str, tmp_path: Path, capfd: Capture
) -> None:
    home = toggle(tmp_path, ('title="Springs of an ejector"', 'title="Springs that eject"'))
    file = home / "plugins" / "toggle.uk.po"
    before = spoil(file.read_bytes())
    file.write_bytes(before)
    known = Discovery([home / "plugins"])
    test, origin = ContractTest(known.mechanism("toggle"), known), known.origins["toggle"][0]
    if told:
        with pytest.raises(UserError, match=told):
            write_missing(test, origin)
        assert file.read_bytes() == before
    else:
        assert list(write_missing(test, origin)) == [file] and b"Springs that eject" in file.read_bytes()
    catalogue.cache_clear()


def test_catalogues_of_the_program_are_not_written(capfd: Capture) -> None:
    assert main(["check-plugin", "parallel_key", "--write-po"]) == 2
    assert "parallel_key comes with the program" in capfd.readouterr().err


def test_a_value_that_is_not_a_number_is_told(tmp_path: Path) -> None:
    tried = contract(tmp_path, *odd("return travel * float('nan')")).tried_alone("example")
    assert tried.status != "pass" and "odd" in tried.faults[0]


def test_a_plugin_that_never_comes_back_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    test = contract(tmp_path, *odd("while True: pass"))
    monkeypatch.setattr("diecut_report.testing.contract.MAX_RULE_SECONDS", 0.2)
    tried = test.tried_alone("example")
    assert tried.status == "broke"
    assert "it did not finish within 0.2 s" in tried.faults[0] and "toggle.py:55" in tried.faults[0]


def test_an_untranslated_text_is_noted(tmp_path: Path) -> None:
    tried = contract(tmp_path, ('title="Springs of an ejector"', 'title="Springs that eject"')).tried_alone("languages")
    assert tried.status == "note"
    assert list(tried.faults) == [
        "uk: “Springs that eject” (mechanism) is not translated",
        "uk: “Springs of an ejector” is in the catalogue but no longer used; --write-po marks it as obsolete",
    ]


@pytest.mark.nightly
def test_a_text_that_nothing_says_any_more_becomes_obsolete_and_comes_back(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path, ('title="Springs of an ejector"', 'title="Springs that eject"'))
    file, page = home / "plugins" / "toggle.uk.po", ("-o", str(tmp_path / "page.html"))
    before = file.read_text("utf-8")
    assert main(["check-plugin", str(home), "--write-po", *page]) == 0
    assert f"written: {file}: 1 text to be translated, 1 text is obsolete" in capfd.readouterr().err
    obsolete = '#~ msgid "Springs of an ejector"\n#~ msgstr "Пружини виштовхувача"\n'
    text = file.read_text("utf-8")
    assert text.rstrip().endswith(obsolete.rstrip())
    assert text.partition("\n\n")[0] == before.partition("\n\n")[0]  # its head stays as it was written
    again = changed(file.read_bytes(), "uk", "toggle", [("Springs of an ejector", "mechanism")], ["Springs that eject"])
    assert (again.added, again.obsolete, again.returned) == (0, 1, 1)
    file.write_bytes(again.content)
    known = read(file, "uk")
    assert known["Springs of an ejector"].string == "Пружини виштовхувача" and not known.obsolete
    assert "Springs that eject" not in known  # it was never translated


def test_a_text_that_is_said_again_has_its_translation_again_and_a_plural_one_is_of_another(tmp_path: Path) -> None:
    home = toggle(tmp_path)
    file, known = home / "plugins" / "toggle.uk.po", Discovery([home / "plugins"])
    before = file.read_text("utf-8")
    entry = 'msgid "Springs of an ejector"\nmsgstr "Пружини виштовхувача"\n'
    assert entry in before
    test, origin = ContractTest(known.mechanism("toggle"), known), known.origins["toggle"][0]
    former = '\n#~ msgid "Springs of an ejector"\n#~ msgstr "Пружини виштовхувача"\n'
    plural = '\n#~ msgid "Springs of an ejector"\n#~ msgid_plural "Springs"\n#~ msgstr[0] "x"\n#~ msgstr[1] "y"\n#~ msgstr[2] "z"\n'
    for end, counts in ((former, (0, 0, 1)), (plural, (1, 0, 0))):
        file.write_text(before.replace(entry, "") + end, "utf-8")
        catalogue.cache_clear()
        test = ContractTest(known.mechanism("toggle"), known)
        made = write_missing(test, origin)[file]
        assert (made.added, made.obsolete, made.returned) == counts
        assert ("Пружини виштовхувача" in file.read_text("utf-8")) is (counts[2] == 1)
    catalogue.cache_clear()


def test_sources_in_words_that_no_catalogue_has_are_told(tmp_path: Path) -> None:
    change = ("a spring's wire\", EN_13906)", 'a spring\'s wire", "theory of beams")')
    tried = contract(tmp_path, change).tried_alone("languages")
    assert tried.status == "pass"
    assert tried.summary == "en, uk; sources that stay as they are given: theory of beams"


def test_sources_in_functions_are_not_asked_for(tmp_path: Path) -> None:
    made = (
        "CONTRACT = 2",
        "def made():\n    return own_table(title='', unit='mm', rows={'a': 1}, sources=('a list of one maker',)), "
        "Source('B', 'A book about springs')\n\n\nCONTRACT = 2",
    )
    test = contract(tmp_path, made, ("    line,\n", "    line,\n    own_table,\n"))
    assert list(test.words.untranslated("uk")) == []


STANDARD = (
    CALLS,
    (
        "springs.rate = total(",
        'springs.size = pick("above", of="travel", series=standard_series("renard_r40_lengths")), "d_n", "mm", "Active turns"\nsprings.rate = total(',
    ),
)


def test_titles_of_standard_series_are_translated_by_the_program(tmp_path: Path) -> None:
    test = contract(tmp_path, *STANDARD)
    assert list(test.words.untranslated("uk")) == []
    title = test.words.catalogues("uk").program.text("Lengths and diameters by preferred numbers R40")
    assert title == "Довжини і діаметри за рядом переважних чисел R40"


def test_what_came_of_extreme_values_is_told_in_words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    test = contract(tmp_path)
    monkeypatch.setattr("diecut_report.testing.extreme_inputs.EXTREMES", 12)
    told = test.tried_alone("hostile").summary
    assert re.fullmatch(
        r"one input at a time set to an extreme value: \d+ gave numbers, \d+ were refused with a message; they are a sample of 142",
        told,
    )
    numbers, refused = (int(each) for each in re.findall(r"\d+", told)[:2])
    assert refused and numbers + refused == 13  # with the empty list


def test_authors_may_assert_the_contract(tmp_path: Path) -> None:
    keys = {"springs": [{"wire": "3 mm", "coil": "24 mm", "turns": 8}], "travel": "10 mm"}
    mechanism = contract(tmp_path, TOO_SOFT).mechanism
    with pytest.raises(AssertionError, match=r"Dimensions of formulas: toggle.py:57: spring_rate: "):
        check_contract(mechanism, keys)


def test_a_plugin_that_breaks_in_its_example_ends_with_3(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path, *odd("raise RuntimeError('it fell over')"))
    assert main(["check-plugin", str(home), "--format", "json"]) == 3
    (whole,) = json.loads(capfd.readouterr().out)
    rules = {rule["rule"]: rule for rule in whole["rules"]}
    assert whole["status"] == rules["example"]["status"] == "broke" and rules["figures"]["status"] == "not_tried"
    assert "RuntimeError: it fell over (toggle.py:" in rules["example"]["faults"][0]


def test_plugins_that_cannot_be_loaded_end_with_3_and_the_others_are_tried(capfd: Capture) -> None:
    assert main(["check-plugin", str(BROKEN), "--format", "json"]) == 3
    whole = {each["kind"]: each for each in json.loads(capfd.readouterr().out)}
    assert "No module named 'library_that_is_not_there'" in whole["breaks_at_import"]["error"]
    assert whole["breaks_in_calculation"]["rules"][0]["status"] == "pass"


def test_a_declaration_that_cannot_be_is_told_with_all_its_faults(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path, ("m.stress,", "m.stres,"), ('"rate", "force")', '"rate", "forc")'))
    assert main(["check-plugin", str(home)]) == 3
    told = capfd.readouterr().out
    assert "check stress: takes stres, which nothing gives (did you mean 'stress'?)" in told and "forc" in told


def test_a_broken_rule_ends_with_1_and_without_a_machine_the_rest_is_not_tried(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path, TOO_SOFT)
    (home / "examples" / "toggle.yaml").unlink()
    assert main(["check-plugin", str(home)]) == 1
    out = capfd.readouterr().out
    assert "  fails  Dimensions of formulas\n      toggle.py:57: spring_rate: " in out
    assert (
        "note  Example machine\n      no machine of this kind is available to test the rest; give a configuration"
        in out
    )
    assert "not tried  Extreme inputs: not run until the rules above are satisfied" in out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nothing",), "'nothing' is not a known kind"),
        (("no/folder",), "no/folder: There is no such folder of plugins"),
        (("{tmp}",), "There is no plugin in this folder"),
        (("clutch", "--config", "{tmp}/none.yaml"), "none.yaml"),
        ((str(BROKEN), "-o", "{tmp}/page.html"), "plugins; name one of them, or give a folder with -o."),
        (("damper", "--config", "{tmp}/press.yaml"), "There is no mechanism of the kind 'damper' in it."),
    ],
)  # fmt: skip
def test_what_cannot_be_asked_ends_with_2(
    tmp_path: Path, capfd: Capture, arguments: tuple[str, ...], words: str
) -> None:
    saved(tmp_path, SMALL)
    assert main(["check-plugin", *(part.format(tmp=tmp_path) for part in arguments)]) == 2
    assert words in capfd.readouterr().err


@pytest.mark.nightly
@pytest.mark.parametrize("kind", ["clutch", "geneva_transport", "platen_press", "parallel_key"])
def test_kinds_of_the_program_hold_the_rules(tmp_path: Path, capfd: Capture, kind: str) -> None:
    assert main(["check-plugin", kind, "-o", str(tmp_path / "page.html")]) == 0, capfd.readouterr().out


@pytest.mark.parametrize("as_package", [False, True])
def test_the_folder_where_one_stands_has_its_own_kinds_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, as_package: bool
) -> None:
    for place, content in contents("toggle", as_package=as_package).items():
        (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / place).write_text(content, "utf-8")
    monkeypatch.chdir(tmp_path)
    known, kinds = meant(".", ())
    assert kinds == ["toggle"] and known.mechanism("toggle").kind == "toggle"


def test_a_list_without_parts_is_refused_in_words(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path)
    example = home / "examples" / "toggle.yaml"
    parts = "    springs:\n      - {wire: 3 mm, coil: 24 mm, turns: 8}\n      - {wire: 2.5 mm, coil: 20 mm, turns: 6}\n"
    text = example.read_text("utf-8")
    assert parts in text
    example.write_text(text.replace(parts, "    springs: []\n"), "utf-8")
    assert main(["calc", str(example), "--plugins", str(home / "plugins"), "--quiet"]) == 2
    assert "toggle.yaml:17:14: mechanisms.toggle.springs: is empty; give at least one" in capfd.readouterr().err


def test_why_the_example_is_refused_is_told_as_validate_tells_it(tmp_path: Path, capfd: Capture) -> None:
    home = toggle(tmp_path)
    example = home / "examples" / "toggle.yaml"
    example.write_text(example.read_text("utf-8").replace("    travel: 10 mm\n", "    trvel: 10 mm\n"), "utf-8")
    assert main(["validate", str(example), "--plugins", str(home / "plugins")]) == 2
    told = [line for line in capfd.readouterr().err.splitlines() if "toggle.yaml:" in line]
    assert any("trvel" in line for line in told)
    assert main(["check-plugin", str(home)]) == 1
    out = capfd.readouterr().out
    assert "fails  Example machine: its configuration is refused" in out and all(line.strip() in out for line in told)

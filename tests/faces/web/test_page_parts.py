"""Parts of the page, each asked by itself on one page that stays open: what they show of what they are given."""

import json
import urllib.parse

import pytest

pytestmark = pytest.mark.slow

#: Where the page that stays open begins.
START = PAPER = "#A=paper&band=0"


@pytest.fixture
def go(opened):
    """Lead the page to another case without loading it again, or to the first one."""
    return lambda fragment=PAPER: opened.lead(fragment)


@pytest.fixture
def paper_checks(server, paper):
    return server.post("check", {"case": paper}).json()["checks"]


#: The panel of checks over a cycle: its class, and its sentence.
PANEL = """async (checks) => {
  const { ofCycle, panel } = ballscrewModules["checks.js"];
  const [words] = panel(ofCycle({ checks }), "checks");
  return [words.className, words.textContent];
}"""


@pytest.mark.parametrize(
    ("first", "second", "tone", "said"),
    [
        (True, True, "good", "All {all} checks hold."),
        (False, True, "careful", "Fails: {first}."),
        (None, True, "", "{most} checks hold. {most} of {all} checks judged."),
        (False, None, "careful", "Fails: {first}. {most} of {all} checks judged."),
    ],
)
def test_the_sentence_of_all_checks(go, paper_checks, first, second, tone, said):
    """One that fails is enough, and one that is not judged does not hold."""
    here = go()
    checks = [{**one, "holds": True} for one in paper_checks]
    checks[0]["holds"], checks[1]["holds"] = first, second
    found = here.page.evaluate(PANEL, checks)
    name = here.page.locator(f"#checks [data-check={checks[0]['name']}] th").inner_text()
    words = said.format(all=len(checks), most=len(checks) - 1, first=name)
    assert found == [f"verdict {tone}", f"Over the cycle: {words}"]


#: Other fields after one has become a text, in a design that gives a play of the nut.
CONSEQUENCES = """async (changes) => {
  const { consequences } = ballscrewModules["consequences.js"];
  const nuts = {
    single: { fields: ["axial_play"], usual_preload: null },
    double: { fields: ["preload", "oversize"], usual_preload: "7 %" },
  };
  const given = (path) => (path === "nut.axial_play" ? "10 um" : undefined);
  return changes.map(([path, text]) => consequences(path, text, given, nuts));
}"""


def test_only_a_kind_of_nut_changes_the_fields_of_the_nut(go):
    found = go().page.evaluate(
        CONSEQUENCES,
        [["nut.type", "double"], ["nut.type", "single"], ["nut.type", "unheard of"], ["screw.catalogue", "double"]],
    )
    assert found == [{"nut.axial_play": "", "nut.preload": "7 %"}, {}, {}, {}]


def test_a_plain_number_has_no_unit(go):
    found = go().page.evaluate(
        """async () => {
          const { unitOf, heading } = ballscrewModules["units.js"];
          return [...["efficiency", "screw_torque", "preload_drag", "of no result"].map(unitOf),
            heading("efficiency", "efficiency"), heading("screw_torque", "torque")];
        }"""
    )
    assert found == ["", "N m", "N m", "", "efficiency", "torque (N·m)"]


def test_the_kind_of_a_segment(go):
    """A way is a move, a time at a speed a stretch, and at none a rest."""
    segments = {
        "move": [{"distance": "300 mm", "speed": "10 m/min"}, {"distance": "1 m"}],
        "stretch": [{"duration": "1 s", "speed": "5 m/min"}, {"duration": "1 s", "speed": "-0.1 m/s"}],
        "rest": [{"duration": "2 s"}, {"duration": "2 s", "speed": "0 m/min"}, {}],
    }
    kinds = "async (all) => { const { kindOf } = ballscrewModules['cards/segments.js']; return all.map(kindOf); }"
    for kind, of_kind in segments.items():
        assert go().page.evaluate(kinds, of_kind) == [kind] * len(of_kind)


#: The entries of a tab whose own is open elsewhere, and of one whose browser refuses locks; null where none is found.
ENTRIES = """async () => {
  const { keeping } = ballscrewModules["keeping.js"];
  const late = () => new Promise((done) => setTimeout(done, 5000, null));
  const begun = () => Promise.race([keeping.begin().then(() => keeping.own()), late()]);
  const first = keeping.own();
  const taken = await begun();
  const { request } = navigator.locks;
  navigator.locks.request = () => Promise.reject(new DOMException("no storage", "SecurityError"));
  try {
    return [first, taken, await begun()];
  } finally {
    navigator.locks.request = request;
  }
}"""


def test_a_tab_has_an_entry_of_its_own(go):
    """A tab that was duplicated has the entry of the other one, which is in use; without locks nobody can tell."""
    entries = go().page.evaluate(ENTRIES)
    assert all(entries)
    assert len(set(entries)) == 3


def test_what_is_kept_is_listed_when_it_is_kept(go):
    """It is kept once typing rests, when nothing else changes on the page."""
    here = go("#A=paper&band=0&view=handover.files")
    here.page.wait_for_selector("#kept-list p")
    here.page.evaluate("() => { const { keeping } = ballscrewModules['keeping.js']; keeping.forget([keeping.own()]); }")
    before = here.page.locator("#kept-list em").count()
    here.type("operation.axial_load", "1234")
    here.page.wait_for_selector("#kept-list em")
    assert before == 0


def test_copies_of_a_design(go):
    """The copy is shown; the last design stays, and there is room for eight."""
    here = go("#A=paper&A.operation.axial_load=1.5+kN&band=0&view=handover.files")

    def disabled(word):
        return here.page.locator(f"#design-list [aria-label^='{word} ']").evaluate_all(
            "all => all.map((one) => one.disabled)"
        )

    here.page.wait_for_selector("#files [aria-label='Copy A']")
    assert (disabled("Delete"), disabled("Copy"), disabled("Show")) == ([True], [False], [True])
    here.page.locator("#files [aria-label='Copy A']").click()
    here.settle().page.wait_for_selector("#files [aria-label='Copy B']")
    assert (disabled("Delete"), disabled("Copy"), disabled("Show")) == ([False] * 2, [False] * 2, [False, True])
    assert here.page.locator("#f-operation-axial_load").input_value() == "1.5"
    go("&".join(["#A=paper", *(f"{letter}=paper" for letter in "BCDEFGH"), "band=0&view=handover.files"]))
    here.page.wait_for_selector("#files [aria-label='Copy H']")
    assert (disabled("Copy"), disabled("Delete")) == ([True] * 8, [False] * 8)
    assert here.page.locator("#add").is_disabled()


def test_the_torque_that_holds_is_shown_where_there_is_a_load_to_hold(go):
    names = "all => all.map((one) => one.dataset.name)"
    loaded = go().page.locator("#numbers data").evaluate_all(names)
    assert {"screw_torque", "drive_torque", "holding_torque"} <= set(loaded)
    unloaded = go("#A=paper&A.operation.axial_load=0+N&A.nut.type=double&A.nut.preload=2+kN&band=0")
    shown = unloaded.page.locator("#numbers data").evaluate_all(names)
    assert "screw_torque" in shown
    assert "holding_torque" not in shown


def test_help_goes_with_the_field(go):
    here = go()
    here.reveal("screw.lead")
    shown = "() => !document.querySelector('#help').hidden"
    here.page.locator("#f-screw-lead").focus()
    assert here.page.evaluate(shown)
    assert "lead" in here.text("#help")
    here.page.locator("#s-screw").focus()  # of no field
    assert not here.page.evaluate(shown)


def test_a_coefficient_that_is_given_is_shown_with_its_law(go):
    """That of the law of the model, which is not named, as a file or a link may have it."""
    here = go("#A=paper&A.model.friction.boundary_friction_coefficient=0.09&band=0")
    field = here.page.locator(here.id("model.friction.boundary_friction_coefficient"))
    assert field.count() == 1
    assert field.input_value() == "0.09"
    assert here.page.locator("#f-model-friction").input_value() == ""


def test_each_band_is_asked_for_once_and_none_of_a_design_at_fault(go):
    """That of the design on the page was asked for a second time for the table, while it was on its way."""
    here = go("#A=paper&B=paper&B.screw.lead=nonsense&show=A&band=0")
    here.page.wait_for_selector("#compare tbody", state="attached")
    asked = []
    here.page.route("**/api/v1/band", lambda route: (asked.append(route.request.post_data), route.continue_()))
    bands = "#A=paper&A.operation.axial_load=3333+N&B=paper&B.screw.lead=nonsense&show=A&band=1"
    go(bands).page.wait_for_function("() => / to /.test(document.querySelector('#compare tbody').textContent)")
    here.rest(300)
    here.page.unroute("**/api/v1/band")
    assert [("3333 N" in body, "nonsense" in body) for body in asked] == [(True, False)]


#: One body asked for twice at once, by somebody who leaves and by somebody who waits.
LEFT = """async (body) => {
  const { ask } = ballscrewModules["server.js"];
  const { fetch } = window;
  let asked = 0;
  window.fetch = (...given) => {
    asked += 1;
    return fetch(...given);
  };
  try {
    const leaves = new AbortController();
    const [one, two] = [leaves, new AbortController()].map(({ signal }) => ask("run", body, signal));
    const before = asked;
    leaves.abort();
    const hasLeft = await one.then(() => false, () => true);
    const { results } = await two;
    return [before, hasLeft, asked, results.screw_torque];
  } finally {
    window.fetch = fetch;
  }
}"""


def test_who_waits_for_an_answer_of_somebody_that_leaves_asks_again(go, server, paper):
    paper["operation"]["axial_load"] = "1777 N"
    torque = server.post("run", {"case": paper}).json()["results"]["screw_torque"]
    assert go().page.evaluate(LEFT, {"case": paper}) == [1, True, 2, torque]


def test_what_fails_without_a_limit_has_no_multiple_of_it(go):
    """A screw that the load turns, where that must not be: torque is left, and no multiple of none of it."""
    rest = {"need": {"rows": "hiwin-40-20k4", "back_driving": "forbidden"}}
    texts = {"axial_load": "3 kN", "feed": "15 m/min", "nut": "double", "preload": "5 %", "running_time": "5000 h",
             "unsupported_length": "1 m", "ends": "fixed-supported"}  # fmt: skip
    need = urllib.parse.quote(json.dumps({"texts": texts, "units": {}, "rest": rest}))
    here = go(f"#A=paper&band=0&view=choose&need={need}")
    here.page.locator("#choose-start").click()
    here.page.wait_for_selector("#choose [role=status]")
    assert here.text("#choose-result tbody tr summary strong") == "Fails: back driving."

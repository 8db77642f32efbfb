"""Constellations and edges are computed from factors; designs that contradict themselves are refused."""

from __future__ import annotations

from itertools import combinations

import pytest
from contact_foundation.errors import InputError
from small_designs import DESIGN_FILE, STAR, design_of, thesis

FACTORS = '[factors]\ncamera = ["one", "two"]\nscene = ["still", "moving"]\n'


def test_the_thesis_has_20_constellations_and_52_edges():
    design = thesis()
    names = {
        f"{technique}/{camera}/{scene}"
        for technique in ("anaglyph", "shutter", "polarised", "plain")
        for camera in ("central", "convergent", "parallel")
        for scene in ("still", "moving")
        if technique != "plain" or camera == "central"
    }
    assert set(design.names) == names
    assert len(design.names) == 20
    apart = [sum(a != b for a, b in zip(c, d, strict=True)) for c, d in combinations(design.constellations, 2)]
    assert len(design.edges) == apart.count(1) == 52


def test_contrasts_lead_from_start_to_end():
    design = thesis()
    contrast = next(c for c in design.contrasts if c.name == "parallel against central")
    edges = design.directed_edges(contrast)
    assert len(edges) == 6
    for start, end in edges:
        first, second = design.constellations[start], design.constellations[end]
        assert first[1] == "central"
        assert second == (first[0], "parallel", first[2])


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[factors", "is no TOML"),
        ("", "factors: is missing or empty"),
        ('[factors]\ncamera = ["one"]', "factors.camera: has fewer than two levels"),
        ('[factors]\ncamera = ["one", "two", "one"]', 'has the level "one" twice'),
        ('[factors]\ncamera = ["one", 2]', "is no list of names"),
        ('[factors]\ncamera = ["one", "a/b"]', "is no list of names"),
        (FACTORS + "[expected]\nedges = 5", "expected.edges: says 5, but the factors give 4"),
        (FACTORS + "[expected]\nconstellations = 3", "says 3, but the factors give 4"),
        (FACTORS + "colour = 3\n[colours]\na = 1", "colours: is not known"),
        (FACTORS + '[[only]]\nwhen = { camera = "three" }\nallow = { scene = "still" }', "no level of"),
        (FACTORS + '[[only]]\nwhen = { lens = "one" }\nallow = { scene = "still" }', 'the factor "lens"'),
        (FACTORS + '[[only]]\nwhen = { camera = "one" }\nallow = { camera = "two" }', 'restricts "camera" by itself'),
        (
            FACTORS + '[[only]]\nwhen = { camera = "one" }\nallow = { scene = "still" }\n'
            '[[only]]\nwhen = { camera = "two" }\nallow = { scene = "moving" }',
            "no steps of one factor lead from one/still to two/moving",
        ),
        (FACTORS + '[[contrast]]\nname = "x"\nfactor = "lens"', "names the factor 'lens'"),
        (
            FACTORS + '[[contrast]]\nname = "x"\nfactor = "camera"\nfrom = "one"\nto = ["one", "two"]',
            'has "one" in `from` and in `to`',
        ),
        (FACTORS + '[[contrast]]\nfactor = "camera"\nfrom = "one"\nto = "two"', "has no name"),
        ("[factors]\n" + "".join(f'f{k} = ["a", "b"]\n' for k in range(8)), "more than 100 constellations"),
    ],
)
def test_designs_that_contradict_themselves_are_refused(text, told):
    with pytest.raises(InputError) as error:
        design_of(text)
    assert told in str(error.value)
    assert "design.toml" in str(error.value)


def test_all_problems_are_told_at_once():
    text = (
        DESIGN_FILE.read_text().replace("edges = 52", "edges = 51").replace("constellations = 20", "constellations = 9")
    )
    with pytest.raises(InputError) as error:
        design_of(text)
    assert "2 problems" in str(error.value)


def test_a_star_is_a_design():
    design = design_of(STAR)
    assert len(design.names) == 4
    assert len(design.edges) == 3

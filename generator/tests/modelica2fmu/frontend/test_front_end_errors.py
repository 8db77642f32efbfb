"""What the front end refuses is told briefly, with the place and a way out; what kills it kills no build."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from contact_data import core_subset, modelica_library
from contact_foundation.errors import InputError
from modelica2fmu.build import build_fmu, translate
from modelica2fmu.library.standard_library import StandardLibrary
from modelica2fmu.phases import PhaseClock

LIBRARY = StandardLibrary(core_subset(), "", "core subset")
BALL = """model Ball
  inner Modelica.Mechanics.MultiBody.World world;
  Modelica.Mechanics.MultiBody.Parts.Body body(m = 2);
end Ball;
"""
# Redeclaring a class of a model as an extension of itself overflows the front end's stack.
ENDLESS = """model Endless
  model Plain
    replaceable model Part
      Real x = 1;
    end Part;
    Part part;
  end Plain;
  extends Plain;
  redeclare model extends Part
    Real y = x;
  end Part;
end Endless;
"""


class Heard:
    """A receiver of progress that remembers it."""

    def __init__(self) -> None:
        self.all: list[tuple[str, float, str]] = []

    def __call__(self, phase: str, fraction: float, message: str = "") -> None:
        self.all.append((phase, fraction, message))

    @property
    def remarks(self) -> list[str]:
        return [message for _, _, message in self.all if message]


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    """What the front end keeps, in an empty cache of the user."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache" / "contactmultibody" / "rumoca"


def kept(cache: Path) -> dict[str, bytes]:
    return {str(path.relative_to(cache)): path.read_bytes() for path in cache.rglob("*.bin")}


def states_of_ball(folder: Path, heard: Heard) -> tuple[str, ...]:
    (folder / "Ball.mo").write_text(BALL)
    return tuple(translate("Ball", [folder / "Ball.mo"], LIBRARY, PhaseClock(heard)).systems.reduction.states)


@pytest.mark.parametrize("preloaded", ["", "libm.so.6"])
def test_the_front_end_answers_the_same_whatever_is_loaded_before_it(tmp_path, monkeypatch, preloaded):
    """The user's choice, also of nothing, comes before the allocator that the front end's process gets."""
    (tmp_path / "Decay.mo").write_text("model Decay Real x(start=1); equation der(x) = -x; end Decay;\n")
    expected = translate("Decay", [tmp_path / "Decay.mo"], LIBRARY).generated.sources
    monkeypatch.setenv("LD_PRELOAD", preloaded)
    assert translate("Decay", [tmp_path / "Decay.mo"], LIBRARY).generated.sources == expected


def test_a_damaged_cache_of_the_front_end_is_made_anew(tmp_path, cache):
    first = states_of_ball(tmp_path, Heard())
    whole = kept(cache)
    assert whole
    noise = random.Random(1)
    for name, content in whole.items():
        (cache / name).write_bytes(noise.randbytes(len(content)))
    heard = Heard()
    assert states_of_ball(tmp_path, heard) == first
    assert any("damaged" in remark and str(cache) in remark for remark in heard.remarks)
    heard = Heard()
    assert states_of_ball(tmp_path, heard) == first
    assert not heard.remarks
    assert kept(cache).keys() == whole.keys()
    assert sorted(path.name for path in cache.parent.iterdir() if "rumoca" in path.name) == ["rumoca"]


def test_a_model_that_kills_the_front_end_is_refused_and_the_cache_stays(tmp_path, cache):
    states_of_ball(tmp_path, Heard())
    whole = kept(cache)
    (tmp_path / "Endless.mo").write_text(ENDLESS)
    with pytest.raises(InputError, match=r"the front end crashed \(SIG") as caught:
        build_fmu("Endless", [tmp_path / "Endless.mo"], tmp_path / "e.fmu")
    assert caught.value.exit_status == 2
    assert caught.value.place is not None
    assert caught.value.place.file == tmp_path / "Endless.mo"
    assert "redeclare ... extends" in (caught.value.remedy or "")
    assert kept(cache) == whole
    assert not (tmp_path / "e.fmu").exists()


@pytest.mark.usefixtures("cache")
def test_a_package_whose_files_do_not_fit_is_named_with_a_few_of_them(tmp_path):
    package = tmp_path / "Broken"
    package.mkdir()
    (package / "package.mo").write_text("package Broken end Broken;\n")
    for k in range(9):
        (package / f"M{k}.mo").write_text(f"model M{k} Real x = 1; end M{k};\n")  # without `within`
    (tmp_path / "Uses.mo").write_text("model Uses extends Broken.M1; end Uses;\n")
    with pytest.raises(InputError, match=r"Broken: is no package: ") as caught:
        build_fmu("Uses", [tmp_path / "Uses.mo", package], tmp_path / "u.fmu")
    text = str(caught.value)
    assert text.count("Broken") < 15
    assert "more\n" in text


def test_a_file_in_another_encoding_is_named(tmp_path):
    (tmp_path / "M.mo").write_bytes('model M "Größe" Real x = 1; end M;'.encode("latin-1"))
    with pytest.raises(InputError, match="UTF-8") as caught:
        build_fmu("M", [tmp_path / "M.mo"], tmp_path / "m.fmu")
    assert caught.value.place is not None
    assert caught.value.place.file == tmp_path / "M.mo"


def test_records_of_all_elements_taken_at_once_are_told_at_their_line(tmp_path):
    (tmp_path / "Balls.mo").write_text("""model Balls
  inner Modelica.Mechanics.MultiBody.World world;
  // ball.collider is told below
  ContactMultiBody.Parts.FreeBody ball[2](
    each m=1, each r_CM={0,0,0}, each I_11=0.004, each I_22=0.004, each I_33=0.004,
    each geometry=ContactMultiBody.Shapes.sphere(0.1));
  ContactMultiBody.ContactManager contacts(n=2, collider=ball.collider);
equation
  connect(ball.frame_a, contacts.frame);
end Balls;
""")
    with pytest.raises(InputError) as caught:
        build_fmu("Balls", [tmp_path / "Balls.mo", modelica_library()], tmp_path / "a.fmu")
    assert "ball.collider, which is not covered" in str(caught.value)
    assert caught.value.remedy == "write {ball[i].collider for i in 1:n}"
    assert caught.value.place is not None
    assert caught.value.place.line == 7


def test_a_reduction_in_a_for_equation_is_named_with_its_line_and_the_way_round(tmp_path: Path) -> None:
    """The front end breaks off with words about its own parts."""
    head = "model Sums\n  Real x[3](start={1, 2, 3}, each fixed=true);\nequation\n"
    source = tmp_path / "Sums.mo"
    source.write_text(
        f"{head}  for i in 1:3 loop\n    der(x[i]) = -x[i]*sum(x[j]*i for j in 1:3);\n  end for;\nend Sums;\n"
    )
    with pytest.raises(InputError, match="sum, product, min or max over an iterator in a for-equation") as caught:
        translate("Sums", [source], LIBRARY)
    assert caught.value.place is not None
    assert caught.value.place.line == 4
    source.write_text(f"{head}  der(x) = {{-x[i]*sum(x[j]*i for j in 1:3) for i in 1:3}};\nend Sums;\n")
    translate("Sums", [source], LIBRARY)

"""Rows of a contact manager's lists that belong to the body at another frame."""

from __future__ import annotations

from pathlib import Path

import pytest
from contact_foundation.errors import InputError
from modelica2fmu.library.standard_library import StandardLibrary, core_subset
from modelica2fmu.translation import translate

MODEL = """model M
  connector Frame
    Real r_0[3];
    flow Real f[3];
  end Frame;
  record Material
    Real mu = 0.1;
  end Material;
  record Collider
    String geometry = "";
    Material material;
  end Collider;
  model Body
    parameter String geometry = "sphere";
    parameter Material material;
    final parameter Collider collider(geometry = geometry, material = material);
    Frame frame_a;
    Frame frame_b;
  equation
    frame_a.r_0 = {0, 0, time};
    frame_b.r_0 = {1, 0, time};
  end Body;
  model Manager
    parameter Integer n = 4;
    parameter Collider collider[n];
    parameter String geometry[n] = collider.geometry;
    parameter Material material[n] = collider.material;
    Frame frame[n];
    Real height[n] = {frame[i].r_0[3]*material[i].mu for i in 1:n};
  equation
    for i in 1:n loop
      frame[i].f = zeros(3);
    end for;
  end Manager;
  Body ball[2](material(mu = {0.1, 0.2}));
  Body box(geometry = "box");
  Body arm;
  parameter Collider given = box.collider;
  Manager contacts(ROWS);
equation
  for i in 1:2 loop
    connect(ball[i].frame_a, contacts.frame[i]);
  end for;
  connect(box.frame_b, contacts.frame[3]);
  connect(arm.frame_a, contacts.frame[4]);
end M;
"""


def checked(folder: Path, rows: str) -> None:
    (folder / "M.mo").write_text(MODEL.replace("ROWS", rows))
    translate("M", [folder / "M.mo"], StandardLibrary(core_subset(), "", "core subset"))


@pytest.mark.parametrize(
    ("rows", "taken", "number", "frame"),
    [
        ("collider = {ball[2].collider, ball[1].collider, box.collider, arm.collider}", "ball[2].collider", 1, 2),
        ("collider = {ball[1].collider, ball[1].collider, box.collider, arm.collider}", "ball[1].collider", 2, 1),
        ("collider = cat(1, ball.collider, {arm.collider, box.collider})", "arm.collider", 3, 4),
        ("geometry = {ball[1].geometry, box.geometry, ball[2].geometry, arm.geometry}", "box.geometry", 2, 3),
        (
            "geometry = {ball[1].geometry, ball[2].geometry, box.geometry, arm.geometry},"
            " material = {ball[1].material, ball[2].material, arm.material, box.material}",
            "arm.material",
            3,
            4,
        ),
    ],
)
def test_another_order_is_refused(tmp_path, rows, taken, number, frame):
    with pytest.raises(InputError) as caught:
        checked(tmp_path, rows)
    owner = taken.rpartition(".")[0]
    assert caught.value.message == (
        f"contacts takes {taken} for contacts.frame[{number}], but {owner} is connected to contacts.frame[{frame}]"
    )
    assert "order of the frames" in (caught.value.remedy or "")
    assert caught.value.exit_status == 2


@pytest.mark.parametrize(
    "rows",
    [
        "collider = {ball[1].collider, ball[2].collider, box.collider, arm.collider}",
        "geometry = {ball[1].geometry, ball[1].geometry, box.geometry, box.geometry}",
        "collider = {ball[1].collider, ball[2].collider, given, arm.collider}",
        'geometry = {"sphere", "sphere", "box", "sphere"}',
    ],
    ids=["the right order", "one for several", "through a parameter", "literals"],
)
def test_what_may_be_right_passes(tmp_path, rows):
    checked(tmp_path, rows)


def test_the_line_is_that_of_the_list(tmp_path):
    with pytest.raises(InputError) as caught:
        checked(tmp_path, "collider = {ball[1].collider, ball[2].collider, arm.collider, box.collider}")
    assert caught.value.place is not None
    text = MODEL.splitlines()
    assert "Manager contacts(" in text[(caught.value.place.line or 0) - 1]

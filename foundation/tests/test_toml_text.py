"""TOML that is none is told with its file."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError
from contact_foundation.toml_text import read_toml


def test_content_is_read(tmp_path):
    file = tmp_path / "a.toml"
    file.write_text("a = 1\n[b]\nc = 'x'\n")
    assert read_toml(file) == {"a": 1, "b": {"c": "x"}}


@pytest.mark.parametrize(
    ("content", "told"),
    [(b"a = ", "is no TOML"), (b"\xff\xfe", "is no UTF-8 text"), (b"a = " + 100_000 * b"[", "is nested too deeply")],
)
def test_what_is_none_is_refused_with_its_file(tmp_path, content, told):
    file = tmp_path / "wrong.toml"
    file.write_bytes(content)
    with pytest.raises(InputError, match=f"wrong.toml.*{told}"):
        read_toml(file)

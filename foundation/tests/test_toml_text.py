"""TOML that is none is told with its file."""

from __future__ import annotations

import pytest
from contact_foundation.errors import InputError
from contact_foundation.toml_text import MAXIMUM_BYTES, read_toml


def test_content_is_read(tmp_path):
    file = tmp_path / "a.toml"
    file.write_text("a = 1\n[b]\nc = 'x'\n")
    assert read_toml(file) == {"a": 1, "b": {"c": "x"}}


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"a = ", "is no TOML"),
        (b"\xff\xfe", "is no UTF-8 text"),
        (b"a = " + 100_000 * b"[", "is nested too deeply"),
        pytest.param(b"#" * (MAXIMUM_BYTES + 1), "is larger than 5 MB", id="large"),
    ],
)
def test_what_is_none_is_refused_with_its_file(tmp_path, content, told):
    file = tmp_path / "wrong.toml"
    file.write_bytes(content)
    with pytest.raises(InputError, match=f"wrong.toml.*{told}"):
        read_toml(file)


def test_what_cannot_be_read_is_refused_with_what_it_should_be(tmp_path):
    with pytest.raises(InputError, match=r"(?s)absent.toml: cannot be read: No such file.*Name a case\."):
        read_toml(tmp_path / "absent.toml", "a case")

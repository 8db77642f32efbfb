"""XML from unknown hands: no entities, no network, limits on size and depth, checked against a schema."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import islice
from pathlib import Path

from contact_foundation.errors import InputError, Place, ProblemList
from lxml import etree

MAXIMUM_BYTES = 16 * 2**20
MAXIMUM_DEPTH = 64
MAXIMUM_PROBLEMS = 20
SEARCHED_FOR_DECLARATION = 4096
XML_SCHEMA = "http://www.w3.org/2001/XMLSchema"

_BROKEN_PATTERN = re.compile(
    r"(?P<place>.*?)\[facet 'pattern'\] The value '(?P<value>.*)' is not accepted by the pattern '(?P<pattern>.*)'\.",
    re.S,
)
_DECLARATION = re.compile(rb"""<\?xml\s+version\s*=\s*["']([0-9.]+)["'][^>]*\?>""")
_COMMENT = re.compile(rb"<!--.*?-->", re.S)
_FIRST_ELEMENT = re.compile(rb"<[A-Za-z_]")
_UNBOUND = re.compile(r"Namespace prefix (\S+)")
_UNBOUND_NAMESPACE = "urn:unbound-prefix:"


def place_of(element: etree._Element | None, file: Path, component: str | None = None) -> Place:
    """Where an element of a file stands; its component is the nearest one with a name if none is given."""
    if element is None:
        return Place(file=file, component=component)
    return Place(file=file, line=line_of(element), component=component or nearest_name(element))


def read_xml(file: Path, maximum_bytes: int = MAXIMUM_BYTES) -> etree._Element:
    """The root element of an XML file.

    Args:
        file: the file.
        maximum_bytes: larger files are refused.

    Raises:
        InputError: the file is missing, too large, not well formed, nested too deep, or declares a document type.
    """
    data = _without_odd_declaration(_read_bytes(file, maximum_bytes))
    end = data.rstrip(b"\0")  # which some programs write behind the end; in UTF-16 one belongs to the last character
    data = end if end.rstrip().endswith(b">") and not end.startswith((b"\xff\xfe", b"\xfe\xff", b"<\0")) else data
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=maximum_bytes > MAXIMUM_BYTES,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        try:
            root = etree.fromstring(data, parser)
        except etree.XMLSyntaxError:
            mended = _with_bound_prefixes(_without_odd_comments(data))
            if mended == data:
                raise
            root = etree.fromstring(mended, parser)
    except etree.XMLSyntaxError as error:
        _refuse_document_type(data, file)
        message = (error.msg or "syntax error").split(", line ")[0]
        raise InputError(
            f"is not well-formed XML: {message}",
            place=Place(file=file, line=error.lineno),
            remedy="Export the file again or repair it in an editor that knows XML.",
        ) from error
    if root.getroottree().docinfo.internalDTD is not None:
        _refuse_document_type(data, file, certain=True)
    _check_depth(root, file)
    return root


def unbound_prefixes(root: etree._Element) -> list[str]:
    """Prefixes that the document uses and binds to no namespace; ``read_xml`` bound each to one of its own."""
    return sorted(
        prefix for prefix, name in root.nsmap.items() if prefix is not None and name.startswith(_UNBOUND_NAMESPACE)
    )


def validate(root: etree._Element, schema_file: Path, file: Path) -> None:
    """Checks a document against an XML schema.

    Raises:
        ProblemList: the document breaks the schema; every problem with its line.
    """
    text = etree.parse(schema_file)
    schema = etree.XMLSchema(text)
    if schema.validate(root):
        return
    namespace = f"{{{root.nsmap.get(None, '')}}}"
    log: Iterable[etree._LogEntry] = schema.error_log  # type: ignore[assignment]  # iterable, though not typed so
    problems = [
        InputError(message.replace(namespace, ""), place=Place(file=file, line=entry.line), remedy=remedy)
        for entry in islice(log, MAXIMUM_PROBLEMS)
        for message, remedy in [_in_words(entry.message, text)]
    ]
    raise ProblemList(f"{file} breaks the schema {schema_file.name}", problems)


def _in_words(message: str, schema: etree._ElementTree) -> tuple[str, str | None]:
    """A message of the schema's processor without a pattern's text, and what the schema says about its type."""
    found = _BROKEN_PATTERN.fullmatch(message)
    if found is None:
        return message, None
    for restriction in schema.iter(f"{{{XML_SCHEMA}}}restriction"):
        patterns = [item.get("value") for item in restriction.iterchildren(f"{{{XML_SCHEMA}}}pattern")]
        if found["pattern"] in patterns:
            documented = restriction.itersiblings(f"{{{XML_SCHEMA}}}annotation", preceding=True)
            words = " ".join(str(text) for item in documented for text in item.itertext())
            return f"{found['place']}the value '{found['value']}' is not allowed.", " ".join(words.split()) or None
    return message, None


def line_of(element: etree._Element) -> int | None:
    """The line an element starts on."""
    line = element.sourceline
    return line if isinstance(line, int) else None


def nearest_name(element: etree._Element) -> str | None:
    """The attribute ``name`` of an element, or of the nearest one around it that has any."""
    current: etree._Element | None = element
    while current is not None and current.getparent() is not None:
        name = current.get("name")
        if name is not None:
            return str(name)
        current = current.getparent()
    return None


def _read_bytes(file: Path, maximum_bytes: int) -> bytes:
    try:
        with file.open("rb") as stream:
            data = stream.read(maximum_bytes + 1)
    except OSError as error:
        raise InputError(
            f"cannot be read: {error.strerror}", place=Place(file=file), remedy="Check the path and the permissions."
        ) from error
    if len(data) > maximum_bytes:
        raise InputError(
            f"is larger than {maximum_bytes // 2**20} MiB",
            place=Place(file=file),
            remedy="Geometry belongs into VRML files beside the XML file.",
        )
    return data


def _without_odd_declaration(data: bytes) -> bytes:
    """Some programs write the declaration with version 0.0, or behind a comment; the text itself is XML 1.0 then."""
    found = _DECLARATION.search(data, 0, SEARCHED_FOR_DECLARATION)
    if found is None or (found.start() == 0 and found.group(1).startswith(b"1.")):
        return data
    root = _FIRST_ELEMENT.search(data)
    if root is not None and root.start() < found.start():
        return data
    # Blanks in its place keep lines and columns.
    return data[: found.start()] + b" " * (found.end() - found.start()) + data[found.end() :]


def _without_odd_comments(data: bytes) -> bytes:
    """The text without comments that hold a double hyphen, which XML forbids and many programs write."""

    def blank(found: re.Match[bytes]) -> bytes:
        inside = found[0][4:-3]
        return re.sub(rb"[^\n]", b" ", found[0]) if b"--" in inside or inside.endswith(b"-") else found[0]

    return _COMMENT.sub(blank, data)


def _with_bound_prefixes(data: bytes) -> bytes:
    """The text with prefixes that are bound to no namespace bound in the root; itself if there are none.

    Robot descriptions carry elements of programs (``drake:``, ``gazebo:``) whose prefix nobody declares.
    """
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False)
    try:
        etree.fromstring(data, parser)
    except etree.XMLSyntaxError:
        # The parser's log: the error's own holds what was wrong with documents before this one, too.
        entries: Iterable[etree._LogEntry] = parser.error_log
        messages = [entry.message for entry in entries if entry.type == etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE]
        prefixes = sorted({found[1] for text in messages if (found := _UNBOUND.match(text)) is not None})
        root = _FIRST_ELEMENT.search(data)
        if not prefixes or root is None:
            return data
        name = re.compile(rb"[^\s/>]+").match(data, root.start() + 1)
        if name is None:
            return data
        bindings = "".join(f' xmlns:{prefix}="{_UNBOUND_NAMESPACE}{prefix}"' for prefix in prefixes)
        return data[: name.end()] + bindings.encode() + data[name.end() :]
    return data


def _refuse_document_type(data: bytes, file: Path, *, certain: bool = False) -> None:
    position = data.find(b"<!DOCTYPE")
    if position < 0 and not certain:
        return
    raise InputError(
        "declares a document type (DOCTYPE), which may hide entities and is not accepted",
        place=Place(file=file, line=data.count(b"\n", 0, max(position, 0)) + 1),
        remedy="Remove the DOCTYPE and write the text of its entities where they are used.",
    )


def _check_depth(root: etree._Element, file: Path) -> None:
    depth = 0
    for event, element in etree.iterwalk(root, events=("start", "end")):
        depth += 1 if event == "start" else -1
        if depth > MAXIMUM_DEPTH:
            raise InputError(
                f"elements are nested deeper than {MAXIMUM_DEPTH}", place=Place(file=file, line=element.sourceline)
            )

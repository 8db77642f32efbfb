"""Where the server listens, whether it encrypts, and the names by which pages may ask for it."""

from __future__ import annotations

import errno
import ipaddress
import socket
import ssl
from dataclasses import dataclass
from pathlib import Path

from contact_foundation.errors import InputError, Place

LOOPBACK = "127.0.0.1"
DEFAULT_PORT = 8420
_LOOPBACK_NAMES = (LOOPBACK, "localhost", "[::1]")
_BACKLOG = 64
_DEFAULT_PORTS = {"http": 80, "https": 443}


@dataclass(frozen=True)
class Listening:
    """Where a server listens.

    Attributes:
        address: of this machine, or a name of it; 0.0.0.0 and :: are all of its addresses.
        certificate: PEM file of the certificate and those that vouch for it; None: no encryption.
        key: PEM file of its key; None: it is in the certificate's file.
    """

    address: str = LOOPBACK
    certificate: Path | None = None
    key: Path | None = None

    @property
    def scheme(self) -> str:
        """What addresses of pages begin with."""
        return "http" if self.certificate is None else "https"

    @property
    def is_loopback(self) -> bool:
        """Whether only this machine can connect."""
        return ipaddress.ip_address(self._resolved()[1]).is_loopback

    @property
    def page_host(self) -> str:
        """The host in the address that is told to operators, without a port."""
        if self._is_every:
            return socket.gethostname()
        return f"[{self.address}]" if ":" in self.address else self.address

    def admits(self, host: str, port: int) -> bool:
        """Whether a header Host, such as ``localhost:8420``, names this server.

        A name that is not this server's may have been made to point here by another site (DNS rebinding). Numbers
        cannot.
        """
        name, colon, number = host.lower().rpartition(":")
        if not colon or number.endswith("]"):
            name, number = host.lower(), str(_DEFAULT_PORTS[self.scheme])
        if number != str(port):
            return False
        if name in (self.page_host.lower(), self.address.lower()):
            return True
        if name in _LOOPBACK_NAMES:
            return self._is_every or self.is_loopback
        return self._is_every and _is_number(name)

    def require_protection(self, insecure: bool) -> None:
        """Raises InputError unless others are kept from reading along, or the user wants it so.

        Args:
            insecure: the user wants it so.
        """
        if self.certificate is None and not insecure and not self.is_loopback:
            raise InputError(
                "other machines could connect, and whoever is on the way could read the token and steer",
                place=Place(component=f"--listen {self.address}"),
                remedy="Give --certificate and --key (PEM files), or --insecure for a network that you trust.",
            )
        if self.certificate is not None:
            self.tls()

    def tls(self) -> ssl.SSLContext:
        """The context of encrypted connections.

        Raises:
            InputError: a file cannot be read, or they do not belong together.
        """
        if self.certificate is None:
            raise ValueError("no certificate")
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        for file in (self.certificate, self.key):
            if file is not None and not file.is_file():
                raise InputError("is no file", place=Place(file=file), remedy="Name a PEM file.")
        try:
            context.load_cert_chain(self.certificate, self.key, password=_no_password)
        except (OSError, ValueError) as error:
            beside = f" with the key {self.key}" if self.key is not None else ", in which its key is sought too,"
            reason = getattr(error, "reason", None) or getattr(error, "strerror", None) or error
            raise InputError(
                f"the certificate{beside} cannot be used: {reason}",
                place=Place(file=self.certificate),
                remedy="Give PEM files of a certificate and of its key, which has no password: --certificate, --key.",
            ) from error
        return context

    def bind(self, port: int) -> socket.socket:
        """A socket bound to a port; 0 takes any free one.

        Raises:
            InputError: the address is none of this machine, the port is in use or not for this user.
        """
        family, address = self._resolved()
        bound = socket.socket(family, socket.SOCK_STREAM)
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            bound.bind((address, port))
            bound.listen(_BACKLOG)
        except OSError as error:
            bound.close()
            if error.errno == errno.EADDRNOTAVAIL:
                raise InputError(
                    "is no address of this machine",
                    place=Place(component=f"--listen {self.address}"),
                    remedy="Give one that it has, or 0.0.0.0 for all of them.",
                ) from error
            in_use = error.errno == errno.EADDRINUSE
            raise InputError(
                "is in use by another program, perhaps another cmb drive"
                if in_use
                else f"cannot be used: {error.strerror}",
                place=Place(component=f"port {port}"),
                remedy="Name another one with --port, or 0 for any that is free.",
            ) from error
        return bound

    @property
    def _is_every(self) -> bool:
        return self.address in ("0.0.0.0", "::")

    def _resolved(self) -> tuple[socket.AddressFamily, str]:
        """Family and number of the address."""
        try:
            found = socket.getaddrinfo(self.address, None, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE)
        except (OSError, UnicodeError) as error:
            raise InputError(
                "is no address and no name that this machine knows",
                place=Place(component=f"--listen {self.address}"),
                remedy="Give an address of this machine, such as 192.168.1.5, or 0.0.0.0 for all of them.",
            ) from error
        family, _, _, _, place = next((entry for entry in found if entry[0] == socket.AF_INET), found[0])
        return family, str(place[0]).partition("%")[0]


def _is_number(host: str) -> bool:
    try:
        ipaddress.ip_address(host.removeprefix("[").removesuffix("]"))
    except ValueError:
        return False
    return True


def _no_password() -> bytes:
    return b""

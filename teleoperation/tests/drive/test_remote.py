"""Operators at other machines: where the server listens, encryption, names and origins, wrong tokens."""

from __future__ import annotations

import asyncio
import http.client
import shutil
import ssl
import subprocess
import threading

import pytest
from cmb.main import main
from contact_foundation.errors import InputError
from interactive_drive.server.access import Access
from interactive_drive.server.drive_server import DriveServer
from interactive_drive.server.listening import Listening
from interactive_drive.server.token_limit import MOST_WRONG, TokenLimit
from websockets.asyncio.client import connect
from websockets.exceptions import InvalidStatus

PORT = 8420


@pytest.fixture(scope="module")
def pem(tmp_path_factory):
    """Certificate and key of 127.0.0.2, and a key of another certificate."""
    if shutil.which("openssl") is None:
        pytest.skip("no openssl is installed (Debian package openssl)")
    folder = tmp_path_factory.mktemp("pem")
    words = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=robot"]
    words += ["-addext", "subjectAltName=IP:127.0.0.2"]
    for name in ("server", "other"):
        files = ["-out", folder / f"{name}.pem", "-keyout", folder / f"{name}.key"]
        subprocess.run([*words, *files], check=True, capture_output=True)
    locked = ["-in", folder / "server.key", "-out", folder / "locked.key", "-passout", "pass:word", "-aes256"]
    subprocess.run(["openssl", "rsa", *locked], check=True, capture_output=True)
    return folder


class TestListening:
    def test_alone_it_is_this_machine_without_encryption(self):
        Listening().require_protection(insecure=False)
        with Listening().bind(0) as bound:
            assert bound.getsockname()[0] == "127.0.0.1"

    @pytest.mark.parametrize("address", ["0.0.0.0", "::", "192.0.2.7"])
    def test_others_need_encryption_or_an_explicit_word(self, address):
        with pytest.raises(InputError, match=r"could read the token and steer(?s:.*)--certificate(?s:.*)--insecure"):
            Listening(address).require_protection(insecure=False)
        Listening(address).require_protection(insecure=True)

    @pytest.mark.parametrize("address", ["localhost", "127.0.0.2", "::1"])
    def test_this_machine_needs_none(self, address):
        Listening(address).require_protection(insecure=False)

    def test_a_name_or_address_that_is_not_this_machines_is_told(self):
        with pytest.raises(InputError, match=r"--listen 192\.0\.2\.7: is no address of this machine"):
            Listening("192.0.2.7").bind(0)
        with pytest.raises(InputError, match="no name that this machine knows"):
            Listening("no-such-machine.invalid").require_protection(insecure=False)

    def test_certificates_are_read_before_anything_is_built(self, pem, tmp_path):
        Listening("0.0.0.0", pem / "server.pem", pem / "server.key").require_protection(insecure=False)
        both = tmp_path / "both.pem"
        both.write_bytes((pem / "server.pem").read_bytes() + (pem / "server.key").read_bytes())
        Listening("0.0.0.0", both).require_protection(insecure=False)
        wrong = tmp_path / "wrong.pem"
        wrong.write_text("no certificate")
        for certificate, key in [
            (pem / "server.pem", None),
            (pem / "server.pem", pem / "other.key"),
            (pem / "server.pem", pem / "locked.key"),
            (wrong, pem / "server.key"),
        ]:
            with pytest.raises(InputError, match=f"{certificate.name}: the certificate(?s:.*)cannot be used"):
                Listening("0.0.0.0", certificate, key).require_protection(insecure=False)
        with pytest.raises(InputError, match="is no file"):
            Listening("0.0.0.0", pem, None).require_protection(insecure=False)


class TestNames:
    @pytest.mark.parametrize(
        ("address", "admitted", "refused"),
        [
            ("127.0.0.1", ["127.0.0.1:8420", "LOCALHOST:8420", "[::1]:8420"], ["192.168.1.5:8420", "localhost"]),
            ("192.0.2.7", ["192.0.2.7:8420"], ["192.0.2.8:8420", "localhost:8420", "evil.example:8420"]),
            (
                "0.0.0.0",
                ["192.0.2.7:8420", "[2001:db8::1]:8420", "localhost:8420"],
                ["evil.example:8420", "1.2.3:8420"],
            ),
        ],
    )
    def test_of_requests(self, address, admitted, refused):
        listening = Listening(address)
        assert all(listening.admits(host, PORT) for host in admitted)
        assert not any(listening.admits(host, PORT) for host in [*refused, "", ":", ":8420", "[::1]:"])

    def test_a_usual_port_is_left_out(self, pem):
        assert Listening("192.0.2.7", pem / "server.pem").admits("192.0.2.7", 443)
        assert Listening("192.0.2.7").admits("192.0.2.7", 80)
        assert not Listening("192.0.2.7").admits("192.0.2.7", 443)

    def test_origins_have_the_servers_scheme(self, pem):
        plain = Access(PORT, print, Listening("192.0.2.7"))
        encrypted = Access(PORT, print, Listening("192.0.2.7", pem / "server.pem"))
        assert plain.admits_origin("http://192.0.2.7:8420")
        assert not plain.admits_origin("https://192.0.2.7:8420")
        assert encrypted.admits_origin("https://192.0.2.7:8420")
        assert not encrypted.admits_origin("http://192.0.2.7:8420")
        assert not encrypted.admits_origin("null")
        assert encrypted.address.startswith("https://192.0.2.7:8420/?token=")


class TestTokenLimit:
    def test_some_wrong_ones_and_then_a_wait(self):
        now = [0.0]
        limit = TokenLimit(lambda: now[0])
        for k in range(MOST_WRONG):
            assert limit.wait("10.0.0.1") == 0
            now[0] = float(k)
            limit.note("10.0.0.1")
        assert limit.wait("10.0.0.1") == 60.0 - (MOST_WRONG - 1)
        assert limit.wait("10.0.0.2") == 0
        now[0] = 60.0
        assert limit.wait("10.0.0.1") == 0

    def test_addresses_of_one_network_count_together(self):
        limit = TokenLimit(lambda: 0.0)
        for k in range(MOST_WRONG):
            limit.note(f"2001:db8::{k}")
            limit.note(f"::ffff:10.0.0.{k}")
        assert limit.wait("2001:db8::ffff") > 0
        assert limit.wait("2001:db8:0:1::1") == 0
        assert limit.wait("::ffff:10.0.0.9") == 0

    def test_many_clients_take_no_memory(self):
        limit = TokenLimit(lambda: 0.0)
        for k in range(5000):
            limit.note(f"10.0.{k // 250}.{k % 250}")
        assert len(limit._wrong) == 1000


@pytest.fixture
def encrypted(plan, session, pem):
    listening = Listening("127.0.0.2", pem / "server.pem", pem / "server.key")
    with listening.bind(0) as bound:
        server = DriveServer(plan, session, bound, lambda _address: None, listening)
        thread = threading.Thread(target=server.serve, daemon=True)
        thread.start()
        yield server
        server.end()
        thread.join(10)
        assert not thread.is_alive()


def test_an_encrypted_page_and_its_connection(encrypted, pem):
    place = encrypted.address.removeprefix("https://").partition("/")[0]
    context = ssl.create_default_context(cafile=pem / "server.pem")
    client = http.client.HTTPSConnection(place, context=context, timeout=20)
    client.request("GET", f"/{encrypted.address.rpartition('/')[2]}")
    answer = client.getresponse()
    answer.read()
    cookie = answer.getheader("set-cookie")
    assert "; Secure" in cookie
    headers = {"Cookie": cookie.partition(";")[0]}
    client.request("GET", "/drive.js", headers=headers)
    assert client.getresponse().status == 200
    client.close()

    # In one thread: the client with a thread for reading reads and writes one TLS connection at a time, which OpenSSL
    # does not allow, and waits for ever when a request is lost by it.
    def connection(origin):
        return connect(
            f"wss://{place}/drive", ssl=context, origin=origin, additional_headers=headers, compression=None, proxy=None
        )

    async def first_message(origin):
        async with asyncio.timeout(20), connection(origin) as page:
            return await page.recv()

    assert '"hello"' in asyncio.run(first_message(f"https://{place}"))
    with pytest.raises(InvalidStatus):
        asyncio.run(first_message("https://evil.example"))


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--listen", "0.0.0.0"], "--listen 0.0.0.0: other machines could connect"),
        (["--key", "{fmu}"], "Give --certificate too"),
        (["--insecure", "--certificate", "{fmu}"], "exclude each other"),
        (["--certificate", "none.pem"], "none.pem: does not exist"),
        (["--certificate", "{fmu}"], "cannot be used"),
        (["--headless", "--listen", "0.0.0.0"], "measures on this machine alone"),
        (["--channel", "delay=fast"], "--channel: delay is no number"),
    ],
)
def test_wrong_words_are_told(pushed_mass, capsys, words, told):
    words = [word.format(fmu=pushed_mass) for word in words]
    assert main(["drive", str(pushed_mass), "--no-browser", "--port", "0", *words]) == 2
    assert told in capsys.readouterr().err


def test_headless_over_a_poor_channel(pushed_mass, capsys):
    words = ["--headless", "--minutes", "0.05", "--port", "0", "--channel", "bandwidth=16kbit,delay=100ms,loss=5%"]
    assert main(["drive", str(pushed_mass), *words]) == 0
    lines = {line[:46].strip(): line[46:].split() for line in capsys.readouterr().out.splitlines()}
    assert "16 kbit/s" in " ".join(lines["simulated channel"])
    assert 0 < float(lines["bytes a second, all"][-1]) < 2100
    age = next(values for name, values in lines.items() if name.startswith("age of a frame"))
    assert 100 < float(age[-6]) < 1000

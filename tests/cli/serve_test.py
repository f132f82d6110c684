"""The server of `swirl lab` survives every request and answers only requests to this machine."""

import os
import shutil
import socket
import subprocess
import sys
import unittest

from program import HANG, SOURCE, InFolder

PAGE = b"<!doctype html><title>page</title>"

# Name, request target and expected status of GET requests with the right Host.
TARGETS = [
    ("the page", "/", 200),
    ("the page by name, with a query", "/index.html?discs=5&seed=%0A", 200),
    ("the Laboratory", "/laboratory.html?view=m", 200),
    ("another file of the folder", "/secret.html", 404),
    ("a bad percent escape in the query", "/?discs=%zz%", 200),
    ("two slashes", "//", 400),
    ("two slashes and a port", "//:99999", 400),
    ("two slashes and a name", "//example.org/", 400),
    ("a slash and a backslash", "/\\", 400),
    ("an absolute address", "http://example.org/", 400),
    ("an absolute address that is not valid", "http://[", 400),
    ("no slash", "index.html", 400),
    ("traversal", "/../../etc/passwd", 404),
    ("encoded traversal", "/%2e%2e/%2e%2e/etc/passwd", 404),
    ("traversal, encoded twice", "/%252e%252e%252fetc%252fpasswd", 404),
    ("encoded slashes", "/..%2f..%2fetc%2fpasswd", 404),
    ("an absolute file", "/etc/passwd", 404),
    ("the server's own file", "/serve.mjs", 404),
    ("an encoded NUL", "/%00", 404),
    ("a bad percent escape", "/%", 404),
    ("an encoded byte that is not UTF-8", "/%ff", 404),
    ("a long target", "/" + 8000 * "a", 404),
]

# Name, bytes, expected status; None: the connection is closed without an answer.
RAW = [
    ("a raw NUL", b"GET /\0 HTTP/1.1\r\nHost: {host}\r\n\r\n", 400),
    ("not HTTP", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", 400),
    ("no Host", b"GET / HTTP/1.1\r\n\r\n", 403),
    ("no Host, HTTP/1.0", b"GET / HTTP/1.0\r\n\r\n", 403),
    ("long headers", b"GET / HTTP/1.1\r\nHost: {host}\r\nX: " + 17_000 * b"x" + b"\r\n\r\n", 431),
    (
        "two lengths",
        b"POST / HTTP/1.1\r\nHost: {host}\r\nContent-Length: 1\r\n" b"Content-Length: 2\r\n\r\nab",
        400,
    ),
    ("a body", b"POST / HTTP/1.1\r\nHost: {host}\r\nContent-Length: 2\r\n\r\nab", 405),
    ("OPTIONS", b"OPTIONS * HTTP/1.1\r\nHost: {host}\r\n\r\n", 405),
    ("DELETE", b"DELETE / HTTP/1.1\r\nHost: {host}\r\n\r\n", 405),
    ("TRACE", b"TRACE / HTTP/1.1\r\nHost: {host}\r\n\r\n", 405),
    ("CONNECT", b"CONNECT example.org:443 HTTP/1.1\r\nHost: {host}\r\n\r\n", None),
    ("an expectation", b"GET / HTTP/1.1\r\nHost: {host}\r\nExpect: nonsense\r\n\r\n", 417),
    (
        "an upgrade",
        b"GET / HTTP/1.1\r\nHost: {host}, Upgrade\r\n" b"Upgrade: websocket\r\n\r\n",
        200,
    ),
]


@unittest.skipUnless(shutil.which("node"), "this test needs Node.js")
class Serve(InFolder):
    def setUp(self):
        super().setUp()
        self.pages = self.path("pages")
        os.mkdir(self.pages)
        for name in ("index.html", "laboratory.html", "secret.html"):
            with open(os.path.join(self.pages, name), "wb") as file:
                file.write(PAGE)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.server = subprocess.Popen(
            ["node", os.path.join(SOURCE, "web", "serve.mjs"), self.pages, str(self.port), "no"],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )
        self.addCleanup(self.end)
        self.assertIn(b"http://localhost:", self.server.stdout.readline())

    def end(self):
        self.server.kill()
        self.server.communicate()

    def answer(self, request):
        """All bytes until the server closes the connection."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=HANG) as connection:
            connection.sendall(request)
            chunks = []
            try:
                while chunk := connection.recv(65536):
                    chunks.append(chunk)
            except ConnectionResetError:
                pass  # the server closed with unread data
        return b"".join(chunks)

    def status(self, request):
        head = self.answer(request).split(b"\r\n", 1)[0]
        return int(head.split()[1]) if head else None

    def get(self, target, host=None):
        host = host if host is not None else f"localhost:{self.port}"
        return (f"GET {target} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").encode(
            "latin1"
        )

    def assert_serves(self):
        self.assertIsNone(self.server.poll(), "the server has ended")
        self.assertIn(PAGE, self.answer(self.get("/")))

    def test_no_target_stops_the_server_or_reaches_another_file(self):
        for name, target, expected in TARGETS:
            with self.subTest(name):
                self.assertEqual(self.status(self.get(target)), expected)
                self.assert_serves()

    def test_no_malformed_or_unusual_request_stops_the_server(self):
        host = f"localhost:{self.port}\r\nConnection: close".encode()
        for name, request, expected in RAW:
            with self.subTest(name):
                self.assertEqual(self.status(request.replace(b"{host}", host)), expected)
                self.assert_serves()

    def test_head_has_no_body(self):
        head = self.answer(self.get("/").replace(b"GET", b"HEAD"))
        self.assertTrue(head.startswith(b"HTTP/1.1 200 ") and head.endswith(b"\r\n\r\n"), head)

    def test_half_open_and_broken_connections_do_not_block_others(self):
        half_open = []
        for sent in (b"", b"GET / HTTP/1.1\r\nHost:", b"GET "):
            half_open += [
                socket.create_connection(("127.0.0.1", self.port), timeout=HANG) for _ in range(20)
            ]
            for connection in half_open[-20:]:
                connection.sendall(sent)
        self.assert_serves()
        for connection in half_open:  # a reset, not an orderly end
            connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
            connection.close()
        self.assert_serves()

    def test_only_names_of_this_machine_are_accepted(self):
        port = self.port
        for host in (
            f"localhost:{port}",
            f"127.0.0.1:{port}",
            f"[::1]:{port}",
            f"LOCALHOST:{port}",
        ):
            self.assertEqual(self.status(self.get("/", host)), 200, host)
        for host in (
            "localhost",
            f"localhost:{port + 1}",
            f"example.org:{port}",
            "example.org",
            "",
            f"localhost.example.org:{port}",
            f"127.0.0.1.example.org:{port}",
            f"example.org#localhost:{port}",
        ):
            self.assertEqual(self.status(self.get("/", host)), 403, host)
        self.assert_serves()

    def test_a_missing_page_is_reported(self):
        os.remove(os.path.join(self.pages, "index.html"))
        for _ in range(2):
            self.assertEqual(self.status(self.get("/")), 500)
        self.assertIsNone(self.server.poll())


if __name__ == "__main__":
    if not shutil.which("node"):
        print("skipped: this test needs Node.js")
        sys.exit(77)
    unittest.main()

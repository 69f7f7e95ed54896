"""A proxy before an S3 server that fails as it is told: errors, answers cut off, a server that is gone, other bytes."""

import contextlib
import http.client
import http.server
import random
import threading
import time


class Proxy(http.server.ThreadingHTTPServer):
    """Listens on a port of its own and hands requests on to `to`, a port of this machine."""

    daemon_threads = True

    def __init__(self, to):
        super().__init__(("127.0.0.1", 0), Handler)
        self.to = to
        self.dice = random.Random(7)
        self.errors = self.cuts = 0.0
        self.gone = self.lies = False
        self.answer = self.hold = None
        self.requests = []
        # The server looks whether an object is there and creates it in two steps; S3 does it in one.
        self.creating = threading.Lock()
        threading.Thread(target=self.serve_forever, daemon=True).start()

    @property
    def url(self):
        return f"http://127.0.0.1:{self.server_address[1]}"

    def well(self):
        self.errors = self.cuts = 0.0
        self.gone = self.lies = False
        self.answer = self.hold = None
        self.requests = []

    def handle_error(self, request, client_address):
        """Who was cut off says nothing."""


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def send(self, status, body, headers=()):
        self.send_response(status)
        for name, value in headers:
            self.send_header(name, value)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def handle_any(self):
        proxy = self.server
        proxy.requests.append((self.command, self.path))
        length = int(self.headers.get("Content-Length") or 0)
        body = self.rfile.read(length)
        while proxy.hold and proxy.hold in self.path and self.command == "PUT":
            time.sleep(0.02)
        if proxy.gone:
            self.close_connection = True
            self.connection.close()
            return
        if proxy.answer and self.command in ("PUT", "POST"):
            status, text = proxy.answer
            self.send(status, text.encode(), [("Content-Type", "application/xml")])
            return
        if proxy.dice.random() < proxy.errors:
            self.send(500, b"<Error><Code>InternalError</Code></Error>")
            return
        with proxy.creating if self.headers.get("If-None-Match") else contextlib.nullcontext():
            to = http.client.HTTPConnection("127.0.0.1", proxy.to, timeout=30)
            to.request(self.command, self.path, body, dict(self.headers))
            got = to.getresponse()
            answer = got.read()
        if proxy.lies and self.command == "GET" and "/cas/" in self.path and got.status == 200:
            answer = bytes([answer[0] ^ 1]) + answer[1:]
        own = ("content-length", "transfer-encoding", "connection", "date", "server")
        headers = [(n, v) for n, v in got.getheaders() if n.lower() not in own]
        if proxy.dice.random() < proxy.cuts:
            # Done, and the answer is lost, or cut in its middle.
            self.close_connection = True
            if answer and self.command == "GET":
                self.send_response(got.status)
                for name, value in headers:
                    self.send_header(name, value)
                self.send_header("Content-Length", str(len(answer)))
                self.end_headers()
                self.wfile.write(answer[: len(answer) // 2])
                self.wfile.flush()
            self.connection.close()
            return
        if self.command == "HEAD":
            self.send_response(got.status)
            for name, value in headers:
                self.send_header(name, value)
            self.send_header("Content-Length", got.getheader("Content-Length", "0"))
            self.end_headers()
            return
        self.send(got.status, answer, headers)

    do_GET = do_PUT = do_POST = do_DELETE = do_HEAD = handle_any

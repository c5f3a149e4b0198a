"""A static server for the tests: can be slow, pause, break off, and take what pages report.

    /media/talk.fbs?hold=4000    sends so many bytes, and the rest when `gate` is set
    /media/talk.fbs?cut=4000     breaks the connection after so many"""
import functools
import gzip
import http.server
import mimetypes
import pathlib
import subprocess
import threading
import time
import urllib.parse

PIECE = 256  # bytes that a slow link sends at once
LATE = 0.1   # seconds that it makes up for, where the machine has slept too long
TYPES = {".wasm": "application/wasm", ".js": "text/javascript", ".mjs": "text/javascript", ".fbs": "application/octet-stream"}


@functools.lru_cache(maxsize=None)
def packed(content, coding):
    """Compressed as well as "gzip" or "br" can."""
    if coding == "gzip":
        return gzip.compress(content, 9, mtime=0)
    script = 'const z = require("zlib"); process.stdout.write(z.brotliCompressSync(require("fs").readFileSync(0)))'
    return subprocess.run(["node", "-e", script], input=content, stdout=subprocess.PIPE, check=True).stdout


class Link:
    """A link of this many bits per second, shared by all answers; None: as fast as the machine."""

    def __init__(self):
        self.rate = None
        self.lock = threading.Lock()
        self.free = 0.0  # when it has sent what it has taken

    def send(self, out, content):
        rate = self.rate
        if rate is None:
            return out.write(content)
        for k in range(0, len(content), PIECE):
            piece = content[k:k + PIECE]
            with self.lock:
                self.free = max(self.free, time.monotonic() - LATE) + len(piece) * 8 / rate
                until = self.free
            time.sleep(max(0, until - time.monotonic()))
            out.write(piece)
            out.flush()


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def do_GET(self):  # pylint: disable=invalid-name
        url = urllib.parse.urlsplit(self.path)
        query = dict(urllib.parse.parse_qsl(url.query))
        path = self.server.find(url.path)
        self.server.asked.append(url.path)
        if path is None:
            self.send_error(404)
            return
        if path.name == self.server.withheld:
            self.server.gate.wait(30)
        content = path.read_bytes()
        self.send_response(200)
        self.send_header("Content-Type", TYPES.get(path.suffix) or mimetypes.guess_type(path.name)[0] or "application/octet-stream")
        coding = self.server.compresses
        if coding and path.suffix in (".js", ".wasm", ".html") and coding in self.headers.get("Accept-Encoding", ""):
            content = packed(content, coding)
            self.send_header("Content-Encoding", coding)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Access-Control-Allow-Origin", "*")
        self.send_header("Cache-Control", "no-store" if query or path.suffix == ".json" or not self.server.cacheable else "max-age=3600")
        self.end_headers()
        cut, hold = (int(query.get(name, len(content))) for name in ("cut", "hold"))
        try:
            self.server.link.send(self.wfile, content[:min(cut, hold)])
            self.wfile.flush()
            if hold < len(content):
                self.server.gate.wait(30)
                self.server.link.send(self.wfile, content[hold:])
        except OSError:
            return
        if cut < len(content):
            self.close_connection = True

    def do_POST(self):  # pylint: disable=invalid-name
        content = self.rfile.read(int(self.headers["Content-Length"]))
        self.server.reports.append((self.path, content))
        self.send_response(200)
        self.send_header("Content-Length", "0")
        self.end_headers()

    def log_message(self, *_):
        pass


class Server(http.server.ThreadingHTTPServer):
    """Serves folders under names: Server({"package": path, ...}). Use as a context."""
    daemon_threads = True

    def __init__(self, folders):
        super().__init__(("127.0.0.1", 0), Handler)
        self.folders = {name: pathlib.Path(folder).resolve() for name, folder in folders.items()}
        self.link = Link()
        self.gate = threading.Event()
        self.compresses = None  # or a coding of packed()
        self.cacheable = True
        self.asked = []  # paths
        self.missing = self.withheld = None  # names of a file that is not there, and of one that waits for the gate
        self.reports = []
        self.thread = threading.Thread(target=self.serve_forever, daemon=True)

    def find(self, path):
        name, _, rest = urllib.parse.unquote(path).lstrip("/").partition("/")
        folder = self.folders.get(name)
        file = (folder / rest).resolve() if folder else None
        return file if file and file.is_file() and file.is_relative_to(folder) and file.name != self.missing else None

    def url(self, path):
        return f"http://127.0.0.1:{self.server_port}/{path}"

    def posted(self, name, seconds=30):
        """Waits for what a page posts to /NAME."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            for k, (path, content) in enumerate(self.reports):
                if path == f"/{name}":
                    del self.reports[k]
                    return content
            time.sleep(0.02)
        raise TimeoutError(f"no report of {name}")

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.shutdown()
        self.server_close()

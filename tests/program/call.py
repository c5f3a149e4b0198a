"""Two ends of samples/call talk to each other, and what they recorded is read. Standard library only."""
import collections
import csv
import dataclasses
import os
import socket
import subprocess

from harness import BUILD, MAX_SECONDS

CALL, PLUGIN = BUILD / "call", BUILD / "gstreamer/libgstfbs.so"
# In the order of the columns that call prints.
COLUMNS = ("faces", "voice", "repair", "rtcp", "all", "lost", "missing", "repaired", "asked", "heard", "given", "shown", "freezes",
           "frozen", "breaks", "broken", "face_delay", "voice_delay", "trip", "rate")
Shown = collections.namedtuple("Shown", "at recorded size")  # s of the monotonic clock; 0: not known; bytes


@dataclasses.dataclass
class End:
    """What one end printed and recorded."""
    total: dict        # of COLUMNS, for all of the call
    seconds: list      # the same for each second
    sent: dict         # "picture", "voice": when the file began
    pictures: list     # of Shown
    voice: list


def read_end(prefix, printed):
    lines = [line.split() for line in printed.splitlines()]
    rows = {True: [], False: []}
    for line in lines:
        if line and (line[0] == "all" or line[0].isdigit()):
            rows[line[0] == "all"].append(dict(zip(COLUMNS, map(float, line[1:]))))
    end = End(rows[True][-1] if rows[True] else {}, rows[False], {}, [], [])
    with open(f"{prefix}.csv", newline="") as rows:
        for what, at, recorded, size in csv.reader(rows):
            if what.startswith("sent "):
                end.sent[what.removeprefix("sent ")] = int(recorded) / 1e9
            else:
                (end.pictures if what == "picture" else end.voice).append(
                    Shown(int(at) / 1e9, int(recorded) / 1e9, int(size)))
    return end


def free_ports():
    """The first of eight UDP ports in a row that nobody listens at."""
    for first in range(20000 + os.getpid() % 2000 * 8, 65000, 8):
        try:
            for port in range(first, first + 8):
                with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
                    probe.bind(("", port))
            return first
        except OSError:
            continue
    raise OSError("no free ports")


def environment(folder, **more):
    return {**os.environ, "GST_PLUGIN_PATH": str(PLUGIN.parent), "GST_REGISTRY": str(folder / "registry.bin"), "LC_ALL": "C",
            **more}


def start(folder, name, files, ports, *options, prefix=(), more={}):
    """Starts one end, which records to `name`.* in the folder.
    @param files  that it sends: pictures and sound
    @param ports  its own and the peer's"""
    command = [*prefix, CALL, "--pictures", files[0], "--sound", files[1], "--port", ports[0], "--peer-port", ports[1],
               "--record", folder / name, *options]
    with open(folder / f"{name}.err", "wb") as errors:
        return subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=errors, cwd=folder,
                                env=environment(folder, **more))


def talk(folder, first, second, *options, seeds=(1, 2), **more):
    """A call of two ends that send files; returns what each received, or raises OSError with what one complained of."""
    port = free_ports()
    ends = [start(folder, name, files, ports, "--seed", seed, *options, **more)
            for name, files, ports, seed in (("a", first, (port, port + 4), seeds[0]),
                                             ("b", second, (port + 4, port), seeds[1]))]
    out = []
    for name, end in zip("ab", ends):
        printed = end.communicate(timeout=MAX_SECONDS)[0].decode()
        if end.returncode != 0:
            raise OSError(f"end {name}: {end.returncode}: {(folder / (name + '.err')).read_text()}")
        out.append(read_end(folder / name, printed))
    return out

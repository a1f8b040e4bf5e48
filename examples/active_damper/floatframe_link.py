"""Talks to `floatframe realtime` over UDP: names, bytes and order of inputs and outputs. Standard library only.

    link = Link(layout, ("127.0.0.1", 47101))       # layout: what `floatframe realtime MODEL --layout --json` prints
    outputs = link.receive(timeout=1.0)             # {"time": 0.001, "sequence": 1, "last": False, "chassis.az": ...}
    link.send({"front_left": 250.0})                # inputs that are not named keep what was sent last
"""
import json
import pathlib
import shutil
import socket
import struct
import subprocess
import sys

HEADER = struct.Struct("<4sHHQQdII")  # magic, version, kind, layout, sequence, time, count, flags
MAGIC, VERSION, INPUTS, OUTPUTS, LAST = b"FFRT", 1, 1, 2, 1


def find_program():
    """build/floatframe of the tree these examples belong to, else floatframe of the search path."""
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "floatframe"
    return str(built) if built.is_file() else shutil.which("floatframe") or str(built)


def read_layout(program, model, *options):
    """The layout of a model, asked from the program. `options`: such as --set name=value."""
    try:
        done = subprocess.run([program, "realtime", str(model), "--layout", "--json", *options], check=False,
                              capture_output=True, text=True)
    except OSError as error:
        sys.exit(f"{program}: {error.strerror}; say with --program where floatframe is")
    if done.returncode != 0:
        sys.exit(done.stderr.strip())
    return json.loads(done.stdout)


class Link:
    def __init__(self, layout, address):
        self.input_names = [s["name"] for s in layout["inputs"]["signals"]]
        self.output_names = [s["name"] for s in layout["outputs"]["signals"]]
        self.input_layout = int(layout["inputs"]["layout"], 16)
        self.output_layout = int(layout["outputs"]["layout"], 16)
        self.input_values = {s["name"]: s["initial"] for s in layout["inputs"]["signals"]}
        self.output_struct = struct.Struct(f"<{len(self.output_names)}d")
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(address)
        self.peer, self.sequence = None, 0

    @property
    def address(self):
        return self.socket.getsockname()

    def close(self):
        self.socket.close()

    def receive(self, timeout=None):
        """The next outputs; None if none came in time. Packets of another layout are ignored."""
        self.socket.settimeout(timeout)
        while True:
            try:
                data, peer = self.socket.recvfrom(65536)
            except (TimeoutError, socket.timeout):
                return None
            if len(data) != HEADER.size + self.output_struct.size:
                continue
            magic, version, kind, layout, sequence, time, _, flags = HEADER.unpack_from(data)
            if (magic, version, kind, layout) != (MAGIC, VERSION, OUTPUTS, self.output_layout):
                continue
            self.peer, self.sequence = peer, sequence
            values = self.output_struct.unpack_from(data, HEADER.size)
            return {"time": time, "sequence": sequence, "last": bool(flags & LAST),
                    **dict(zip(self.output_names, values))}

    def send(self, values):
        """Answers the outputs that were received last."""
        self.input_values.update(values)
        numbers = [self.input_values[name] for name in self.input_names]
        self.socket.sendto(HEADER.pack(MAGIC, VERSION, INPUTS, self.input_layout, self.sequence, 0.0, len(numbers), 0)
                           + struct.pack(f"<{len(numbers)}d", *numbers), self.peer)

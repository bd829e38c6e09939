"""Looks at the gallery in a headless browser: every machine loads, moves, keeps what it should, and looks as it did.

    python3 check.py            compare the pictures with pictures.json
    python3 check.py --bless    write pictures.json anew

Pictures are compared loosely: as the mean brightness of coarse tiles of the page before the machine moves."""

import functools
import http.server
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import threading
import zlib

HERE = pathlib.Path(__file__).parent
SITE = HERE / "site"
# without npm the page does without it
KATEX = (SITE / "fonts").is_dir()
TILES = (16, 12)
# a tile may differ by so much of the brightest: fonts differ from machine to machine
LOOSE = 0.12

FLAGS = [
    "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--force-prefers-reduced-motion",
    "--enable-logging=stderr",
]


def browser(*arguments):
    with tempfile.TemporaryDirectory() as profile:
        done = subprocess.run(
            ["chromium", *FLAGS, f"--user-data-dir={profile}", *arguments],
            capture_output=True, text=True, timeout=180, check=True)
    spoken = [line for line in done.stderr.splitlines() if ":CONSOLE" in line]
    return done.stdout, spoken


def tiles(path):
    """Mean brightness of the tiles of a PNG picture, each from 0 to 1."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at:at + 4]), data[at + 4:at + 8]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", data[at + 8:at + 18])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    channels = {0: 1, 2: 3, 6: 4}[colour]
    assert depth == 8, depth
    raw, stride = zlib.decompress(packed), width * channels
    before, sums, counts = bytearray(stride), {}, {}
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up, corner = before[i], before[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + up) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
                row[i] = (row[i] + near[2]) & 255
        before = row
        for x in range(width):
            tile = (y * TILES[1] // height, x * TILES[0] // width)
            sums[tile] = sums.get(tile, 0) + sum(row[x * channels:x * channels + min(channels, 3)])
            counts[tile] = counts.get(tile, 0) + min(channels, 3)
    return [round(sums[tile] / counts[tile] / 255, 3) for tile in sorted(sums)]


# as the guidelines for accessible pages ask of small text
CONTRAST = 4.5


def brightness(colour):
    """The relative luminance of `#rrggbb`."""
    parts = [int(colour[at:at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear))


def faint_words(style):
    """Colours of text that are too near to what is behind it, in the light and in the dark."""
    # `color` of the page, and `fill` of the words of a diagram
    written = set(re.findall(r"(?:[{;]\s*color:|text\.\w+ \{ fill:)\s*var\(--(\w+)\)", style)) - {"paper"}
    faults = []
    for scheme in re.findall(r":root \{(.*?)\}", style, re.S):
        colours = dict(re.findall(r"--(\w+): (#\w{6});", scheme))
        for name in sorted(written):
            for behind in ("paper", "card"):
                dark, light = sorted([brightness(colours[name]), brightness(colours[behind])])
                ratio = (light + 0.05) / (dark + 0.05)
                if ratio < CONTRAST:
                    faults.append(f"text of the colour {name} has a contrast of {ratio:.1f} to {behind}")
    return faults


def main():
    handler = functools.partial(Quiet, directory=SITE)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{server.server_address[1]}"
    faults = faint_words((HERE / "web" / "style.css").read_text())

    page, spoken = browser("--virtual-time-budget=20000", "--window-size=390,844", "--dump-dom", f"{address}/?check")
    faults += spoken
    found = re.search(r'<pre id="checked">(.*?)</pre>', page, re.S)
    if not found:
        sys.exit("the page did not try its machines: " + "\n".join(spoken) + page[:2000])
    machines = json.loads(found.group(1))
    for machine in machines:
        name = machine["name"]
        if machine.get("fault"):
            faults.append(f"{name}: {machine['fault']}")
        if not machine["moved"]:
            faults.append(f"{name}: nothing moves")
        if machine["conservative"] and not machine["drift"] < 1e-6:
            faults.append(f"{name}: the energy drifts by {machine['drift']}")
        if not machine["off"] < 1e-9:
            faults.append(f"{name}: off its constraints by {machine['off']}")
        if machine["wider"] > 0:
            faults.append(f"{name}: the page is {machine['wider']} pixels wider than a phone")
        if not machine["equations"] or machine["wrong"]:
            faults.append(f"{name}: {machine['equations']} equations, {machine['wrong']} wrong")
        if machine["set"] != machine["equations"] and KATEX:
            faults.append(f"{name}: equations that are not set")
        print(f"{name:18} energy off by {machine['drift']:.1e}")
    if len(machines) < 14:
        faults.append(f"{len(machines)} machines, not fourteen")

    pictures = {}
    for machine in machines:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "page.png"
            _, spoken = browser("--virtual-time-budget=5000", f"--screenshot={path}", "--window-size=640,480",
                                f"{address}/#{machine['name']}")
            faults += spoken
            pictures[machine["name"]] = tiles(path)
    blessed = HERE / "pictures.json"
    if "--bless" in sys.argv:
        blessed.write_text(json.dumps(pictures, separators=(",", ":")).replace("],", "],\n") + "\n")
    known = json.loads(blessed.read_text())
    for name, picture in pictures.items():
        off = max(abs(a - b) for a, b in zip(picture, known.get(name, [2.0] * len(picture))))
        if off > LOOSE:
            faults.append(f"{name}: a tile of its picture differs by {off:.2f}")
    if faults:
        sys.exit("\n".join(faults))
    print(f"{len(machines)} machines in the browser, as they should be")


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


if __name__ == "__main__":
    main()

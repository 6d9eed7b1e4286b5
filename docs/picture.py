"""Draws side views of the occupant in the compartment from a result file, as in the report's Figs 21 to 38.

    python -m pip install mcap mcap-protobuf-support
    python docs/picture.py RUN.mcap OUT.svg 0 0.04 0.08 0.12 0.16 0.2
"""

import sys
from collections import defaultdict

from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

SCALE = 165  # pixels a metre
X_RANGE, Z_RANGE = (-0.62, 1.05), (-0.92, 0.45)  # vehicle axes, m
PAD, COLUMNS = 14, 3
LIMB_M = {  # how thick a segment is drawn
    "upper_torso": 0.20, "middle_torso": 0.20, "lower_torso": 0.20, "head": 0.07, "thigh": 0.13, "lower_leg": 0.09,
    "upper_arm": 0.08, "forearm": 0.07,
}


def read(path, times_s):
    """Messages of the given times by topic, and the surfaces' outlines."""
    frames, lines = {t: {} for t in times_s}, []
    with open(path, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            if channel.topic == "/scene/compartment":
                for entity in decoded.entities:
                    lines += [[(p.x, p.z) for p in line.points] for line in entity.lines]
            for t in times_s:
                if abs(message.log_time * 1e-9 - t) < 2e-4:
                    frames[t][channel.topic] = decoded
    return frames, lines


class Panel:
    def __init__(self, column, row, time_s):
        width, height = ((r[1] - r[0]) * SCALE for r in (X_RANGE, Z_RANGE))
        self.x0, self.y0 = PAD + column * (width + PAD), PAD + row * (height + PAD)
        self.out = [
            f'<g clip-path="url(#c)" transform="translate({self.x0:.1f} {self.y0:.1f})">',
            f'<rect class="room" width="{width:.1f}" height="{height:.1f}"/>',
        ]
        self.label = f'<text x="10" y="{(Z_RANGE[1] - Z_RANGE[0]) * SCALE - 10:.0f}">{time_s * 1000:.0f} ms</text>'

    def at(self, x, z):
        return f"{(x - X_RANGE[0]) * SCALE:.1f},{(z - Z_RANGE[0]) * SCALE:.1f}"

    def polyline(self, points, css, width_m=None, closed=False):
        wide = f' stroke-width="{width_m * SCALE:.1f}"' if width_m else ""
        shape = "polygon" if closed else "polyline"
        self.out.append(f'<{shape} class="{css}"{wide} points="{" ".join(self.at(*p) for p in points)}"/>')

    def circle(self, x, z, radius_m, css):
        cx, cy = self.at(x, z).split(",")
        self.out.append(f'<circle class="{css}" cx="{cx}" cy="{cy}" r="{radius_m * SCALE:.1f}"/>')

    def arrow(self, x, z, fx, fz):
        self.polyline([(x, z), (x + fx, z + fz)], "force")

    def end(self):
        return self.out + [self.label, "</g>"]


def draw(panel, messages, outlines, radii):
    for outline in outlines:
        panel.polyline(outline, "surface", closed=True)
    segments = {k.split("/")[-1]: m for k, m in messages.items() if k.startswith("/occupant/segment/")}
    for side in ("right", "", "left"):
        for name, m in segments.items():
            if name.split("_")[0] not in ("left", "right") and side == "" or side and name.startswith(side):
                width = next(w for key, w in LIMB_M.items() if key in name)
                upper = messages["/occupant/sphere/head"].centre_vehicle_m if name == "head" else m.upper_end_vehicle_m
                ends = (upper, m.lower_end_vehicle_m)
                panel.polyline([(p.x, p.z) for p in ends], f"limb {side}", width)
    for topic, m in messages.items():
        if topic.startswith("/occupant/sphere/"):
            c, f = m.centre_vehicle_m, m.contact_force_vehicle_n
            panel.circle(c.x, c.z, radii[topic.split("/")[-1]], "touching" if m.touches else "sphere")
            if m.touches:
                panel.arrow(c.x, c.z, f.x * 4e-5, f.z * 4e-5)
    for entity in getattr(messages.get("/scene/belts"), "entities", []):
        for line in entity.lines:
            panel.polyline([(p.x, p.z) for p in line.points], "belt")


def sphere_radii(path):
    """Radii from the sphere scene."""
    with open(path, "rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        for _, _, _, scene in reader.iter_decoded_messages(topics=["/scene/spheres"]):
            names = [(e.id, s.size.x / 2) for e in scene.entities for s in e.spheres]
            return defaultdict(lambda: 0.05, {n.split("/")[-1]: r for n, r in names})
    return defaultdict(lambda: 0.05)


def main(source, target, *times):
    times_s = [float(t) for t in times]
    frames, outlines = read(source, times_s)
    radii = sphere_radii(source)
    width, height = ((r[1] - r[0]) * SCALE for r in (X_RANGE, Z_RANGE))
    rows = -(-len(times_s) // COLUMNS)
    total = (PAD + COLUMNS * (width + PAD), PAD + rows * (height + PAD))
    body = []
    for i, t in enumerate(times_s):
        panel = Panel(i % COLUMNS, i // COLUMNS, t)
        draw(panel, frames[t], outlines, radii)
        body += panel.end()
    style = """
      .room { fill: #f7f8fa } text { font: 600 14px system-ui, sans-serif; fill: #333 }
      .surface { fill: #7a93ad; fill-opacity: .12; stroke: #51687f; stroke-width: 1.4 }
      .limb { stroke: #d9a066; stroke-linecap: round; fill: none } .right { stroke: #c48a50 } .left { stroke: #e8b57f }
      .sphere { fill: #b9763b; fill-opacity: .25; stroke: #8c5426 } .touching { fill: #d33; fill-opacity: .35; stroke: #a11 }
      .belt { stroke: #223; stroke-width: 3; fill: none } .force { stroke: #c00; stroke-width: 2 }"""
    with open(target, "w", encoding="utf-8") as out:
        out.write(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{total[0]:.0f}" height="{total[1]:.0f}" '
            f'viewBox="0 0 {total[0]:.0f} {total[1]:.0f}">\n<style>{style}\n</style>\n'
            f'<clipPath id="c"><rect width="{width:.1f}" height="{height:.1f}" rx="6"/></clipPath>\n'
            + "\n".join(body)
            + "\n</svg>\n"
        )


if __name__ == "__main__":
    main(*sys.argv[1:])

"""A result file as a recording of Rerun, whose own reader of MCAP draws no `foxglove.SceneUpdate`.

    python -m pip install rerun-sdk mcap mcap-protobuf-support
    python -m occupant.to_rerun run.mcap -o run.rrd      # or python to_rerun.py, without the module

Everything that the scene of the file shows is translated, nothing computed: limbs, contact spheres, surfaces, belts, forces,
names. Lengths are in m; the vehicle's Z points down. The timeline `run` counts from the start of the run.
"""

import argparse
import math
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

try:
    import rerun as rr
    from mcap.exceptions import McapError
    from mcap.reader import make_reader
    from mcap_protobuf.decoder import DecoderFactory
except ImportError as missing:
    sys.exit(f"error: {missing}\n = help: python -m pip install rerun-sdk mcap mcap-protobuf-support")

SIDES = 24
"""Of a limb, which is a cone between two ellipses."""


def xyz(v: Any) -> list[float]:
    return [v.x, v.y, v.z]


def turn(q: Any) -> rr.Quaternion:
    return rr.Quaternion(xyzw=[q.x, q.y, q.z, q.w])


def colour(c: Any) -> list[int]:
    return [round(255 * part) for part in (c.r, c.g, c.b, c.a)]


def placed(pose: Any, point: Iterable[float]) -> list[float]:
    """A point of a pose's axes in those of its frame: p + q v q⁻¹."""
    x, y, z = point
    q, p = pose.orientation, pose.position
    tx, ty, tz = 2 * (q.y * z - q.z * y), 2 * (q.z * x - q.x * z), 2 * (q.x * y - q.y * x)
    return [
        p.x + x + q.w * tx + q.y * tz - q.z * ty,
        p.y + y + q.w * ty + q.z * tx - q.x * tz,
        p.z + z + q.w * tz + q.x * ty - q.y * tx,
    ]


def ellipsoids(spheres: Any) -> rr.Ellipsoids3D:
    return rr.Ellipsoids3D(
        centers=[xyz(s.pose.position) for s in spheres],
        half_sizes=[[0.5 * side for side in xyz(s.size)] for s in spheres],
        quaternions=[turn(s.pose.orientation) for s in spheres],
        colors=[colour(s.color) for s in spheres],
        fill_mode=rr.components.FillMode.Solid,
    )


def cone(cylinder: Any) -> rr.Mesh3D:
    """The skin of a cylinder whose ends are of different size; its ends lie within ellipsoids."""
    size = cylinder.size
    corners = []
    for z, scale in ((-0.5, cylinder.bottom_scale), (0.5, cylinder.top_scale)):
        for side in range(SIDES):
            angle = 2 * math.pi * side / SIDES
            across = (0.5 * scale * size.x * math.cos(angle), 0.5 * scale * size.y * math.sin(angle), z * size.z)
            corners.append(placed(cylinder.pose, across))
    triangles = []
    for side in range(SIDES):
        following = (side + 1) % SIDES
        triangles += [[side, following, SIDES + following], [side, SIDES + following, SIDES + side]]
    return rr.Mesh3D(vertex_positions=corners, triangle_indices=triangles, albedo_factor=colour(cylinder.color))


def strip(line: Any) -> list[list[float]]:
    points = [placed(line.pose, xyz(p)) for p in line.points]
    is_loop = line.type == line.LINE_LOOP
    return points + points[:1] if is_loop else points


def strips(lines: Any) -> rr.LineStrips3D:
    colours = [colour(line.colors[0] if line.colors else line.color) for line in lines]
    return rr.LineStrips3D([strip(line) for line in lines], colors=colours)


def mesh(triangles: Any) -> rr.Mesh3D:
    corners = [placed(triangles.pose, xyz(p)) for p in triangles.points]
    indices = list(triangles.indices) or list(range(len(corners)))
    faces = [indices[i : i + 3] for i in range(0, len(indices), 3)]
    return rr.Mesh3D(vertex_positions=corners, triangle_indices=faces, albedo_factor=colour(triangles.color))


def arrows(of: Any) -> rr.Arrows3D:
    tips = [placed(a.pose, (a.shaft_length + a.head_length, 0, 0)) for a in of]
    origins = [xyz(a.pose.position) for a in of]
    vectors = [[t - o for t, o in zip(tip, origin)] for tip, origin in zip(tips, origins)]
    return rr.Arrows3D(origins=origins, vectors=vectors, colors=[colour(a.color) for a in of])


def texts(of: Any) -> rr.Points3D:
    return rr.Points3D([xyz(t.pose.position) for t in of], labels=[t.text for t in of], radii=[0.005] * len(of))


def parts(entity: Any) -> Iterable[tuple[str, Any]]:
    """What Rerun shows of an entity, by a name each."""
    for name, kind in (("spheres", ellipsoids), ("lines", strips), ("arrows", arrows), ("texts", texts)):
        of = getattr(entity, name)
        if of:
            yield name, kind(of)
    for name, kind in (("cylinders", cone), ("triangles", mesh)):
        for i, one in enumerate(getattr(entity, name)):
            yield f"{name}/{i}", kind(one)


def tree(frame: str, parents: dict[str, str]) -> str:
    """Where a frame stands below the outermost one."""
    above = f"{tree(parents[frame], parents)}/" if frame in parents else ""
    return above + frame.replace("/", "_")


class Writer:
    """Logs messages in their order; entities that a later message of their topic leaves out are cleared."""

    def __init__(self, recording: rr.RecordingStream) -> None:
        self.recording = recording
        self.parents: dict[str, str] = {}
        self.shown: dict[str, set[str]] = {}

    def transforms(self, message: Any) -> None:
        for t in message.transforms:
            self.parents[t.child_frame_id] = t.parent_frame_id
            place = rr.Transform3D(translation=xyz(t.translation), quaternion=turn(t.rotation))
            self.recording.log(tree(t.child_frame_id, self.parents), place)

    def scene(self, topic: str, message: Any) -> None:
        shown = self.shown.setdefault(topic, set())
        now = {f"{tree(e.frame_id, self.parents)}/{topic.rsplit('/')[-1]}/{e.id}": e for e in message.entities}
        if message.deletions:
            for gone in shown - set(now):
                self.recording.log(gone, rr.Clear(recursive=True))
            shown.clear()
        for path, entity in now.items():
            for name, part in parts(entity):
                self.recording.log(f"{path}/{name}", part)
        shown.update(now)


def convert(source: Path, target: Path) -> int:
    """Writes the scene of a result file as a recording; how many of its messages were translated.

    Raises ValueError where the file holds no scene.
    """
    with source.open("rb") as stream:
        scenes = ("foxglove.SceneUpdate", "foxglove.FrameTransforms")
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        found = [
            (message.log_time, schema.name == scenes[0], channel.topic, decoded)
            for schema, channel, message, decoded in reader.iter_decoded_messages()
            if schema.name in scenes
        ]
    if not found:
        raise ValueError("it holds no scene; give a file that `occupant run` has written")
    # frames before what stands in them
    found.sort(key=lambda row: (row[0], row[1]))
    recording = rr.RecordingStream("occupant", recording_id=source.stem)
    recording.save(target)
    recording.log("space", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    writer = Writer(recording)
    for time_ns, is_scene, topic, decoded in found:
        recording.set_time("run", duration=1e-9 * time_ns)
        if is_scene:
            writer.scene(topic, decoded)
        else:
            writer.transforms(decoded)
    recording.flush()
    return len(found)


def main() -> None:
    parser = argparse.ArgumentParser(prog="occupant.to_rerun", description="Writes a run as a recording of Rerun.")
    parser.add_argument("run", type=Path, metavar="RUN.mcap")
    parser.add_argument("-o", "--output", type=Path, metavar="RUN.rrd", help="beside the run if absent")
    parser.add_argument("-f", "--force", action="store_true", help="replace a file that exists")
    args = parser.parse_args()
    output = args.output or args.run.with_suffix(".rrd")
    if output.exists() and not args.force:
        sys.exit(f"error: {output} exists; replace it with --force, or choose another name with -o")
    try:
        count = convert(args.run, output)
    except (OSError, ValueError, McapError) as error:
        sys.exit(f"error: {args.run}: {error}")
    print(f"wrote {output}: {count} messages of the scene\nnext: rerun {output}", file=sys.stderr)


if __name__ == "__main__":
    main()

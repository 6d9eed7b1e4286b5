"""Reads a result file with the public Python readers alone and checks what docs/mcap.md promises.

    python -m pip install mcap mcap-protobuf-support
    python read_back.py RUN.mcap

With the package foxglove-schemas-protobuf installed, the viewer's types are compared with Foxglove's own.
"""

import hashlib
import importlib
import json
import math
import sys
from collections import defaultdict

from google.protobuf import descriptor_pb2
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

SEGMENTS = (
    "middle_torso upper_torso head lower_torso left_upper_arm right_upper_arm left_forearm right_forearm "
    "left_thigh right_thigh left_lower_leg right_lower_leg"
).split()
ONCE = {"/scene/compartment", "/scene/body", "/scene/spheres", "/scene/labels"}
FRAMES = {"/tf", "/scene/belts", "/scene/forces"}
SCHEMAS = {"/tf": "foxglove.FrameTransforms", "/log": "foxglove.Log"}


def expect(condition, words):
    if not condition:
        sys.exit(f"read_back: {words}")


def check_records(reader):
    metadata = list(reader.iter_metadata())
    expect(metadata[0].name == "occupant.run", "the first metadata record is not occupant.run")
    expect(metadata[-1].name == "occupant.result", "no occupant.result: the run was cut off")
    run, result = metadata[0].metadata, metadata[-1].metadata
    expect(result["status"] in ("completed", "stopped", "failed"), f"status {result['status']}")
    attachments = {a.name: a for a in reader.iter_attachments()}
    scenario = attachments[run["scenario"]]
    digest = hashlib.sha256(scenario.data).hexdigest()
    expect(digest == run["scenario_sha256"], "the scenario is not the one that was hashed")
    expect("3D!scene" in json.loads(attachments["layout.json"].data)["configById"], "no scene in the layout")
    return run, result


def check_schemas(summary):
    compared = set()
    for channel in summary.channels.values():
        schema = summary.schemas.get(channel.schema_id)
        expect(schema is not None, f"{channel.topic} has no schema")
        expect((channel.message_encoding, schema.encoding) == ("protobuf", "protobuf"), channel.topic)
        wanted = SCHEMAS.get(channel.topic)
        if channel.topic.startswith("/scene/"):
            wanted = "foxglove.SceneUpdate"
        expect(schema.name == wanted if wanted else schema.name.startswith("occupant."), schema.name)
        compared |= compare_with_foxglove(schema)
    return compared


def compare_with_foxglove(schema):
    """Names of the types that agree with Foxglove's package in every field."""
    files = descriptor_pb2.FileDescriptorSet.FromString(schema.data).file
    agreed = set()
    for message in (m for f in files if f.package == "foxglove" for m in f.message_type):
        try:
            module = importlib.import_module(f"foxglove_schemas_protobuf.{message.name}_pb2")
        except ImportError:
            return agreed
        theirs = descriptor_pb2.DescriptorProto()
        getattr(module, message.name).DESCRIPTOR.CopyToProto(theirs)
        fields = lambda m: [(f.name, f.number, f.type, f.label, f.type_name) for f in m.field]
        expect(fields(message) == fields(theirs), f"foxglove.{message.name} differs from Foxglove's")
        enums = lambda m: [(e.name, [(v.name, v.number) for v in e.value]) for e in m.enum_type]
        expect(enums(message) == enums(theirs), f"enums of foxglove.{message.name} differ from Foxglove's")
        agreed.add(message.name)
    return agreed


def check_transforms(message, topic_time_ns):
    names = [t.child_frame_id for t in message.transforms]
    expect(names[0] == "vehicle", f"frames {names}")
    # the report's twelve in its order; other trees have more, a body on a mount may have few
    others = [name for name in names if name.startswith("frames/") or name.endswith("/origin")]
    # what gives way on a segment hangs on it
    riding = {t.child_frame_id: t.child_frame_id.rpartition("/")[0] for t in message.transforms if t.child_frame_id.rpartition("/")[0] in names}
    own = [name.removeprefix("occupant/") for name in names[1:] if name not in others and name not in riding]
    expect(own == list(SEGMENTS) if len(own) == 12 else len(own) == len(set(own)) > 0, f"frames {names}")
    for t in message.transforms:
        q = t.rotation
        norm = math.sqrt(q.x**2 + q.y**2 + q.z**2 + q.w**2)
        expect(abs(norm - 1) < 1e-12, f"{t.child_frame_id}: a quaternion of length {norm}")
        parent = "space" if t.child_frame_id in ("vehicle", *others) else riding.get(t.child_frame_id, "vehicle")
        expect(t.parent_frame_id == parent, f"{t.child_frame_id} hangs on {t.parent_frame_id}")
        ns = t.timestamp.ToNanoseconds()
        expect(ns == topic_time_ns, f"{t.child_frame_id}: time {ns}, message {topic_time_ns}")
    return own


def topic_of(segment):
    """Of the frame's name without `occupant/`; of one of several bodies that is `occupants/NAME/SEGMENT`."""
    body, _, part = segment.rpartition("/")
    return f"/{body or 'occupant'}/segment/{part}"


# what no instrument reads is no number there, and what was never seen is minus infinity
MAY_LACK = {"greatest", "readings_before", "readings"}


def check_numbers(topic, message):
    """Every number of a group is finite, but for what a body may lack."""
    for field, value in message.ListFields():
        if topic == "/checkpoint" and field.name in MAY_LACK:
            continue
        values = value if field.is_repeated else [value]
        for v in values:
            if field.message_type is not None:
                check_numbers(f"{topic}.{field.name}", v)
            elif isinstance(v, float):
                expect(math.isfinite(v), f"{topic}.{field.name} is {v}")


def check_checkpoint(message):
    """Lists that belong together are as long as one another, and pairs are numbers of pairs."""
    # 12, 7 of each free segment, 2 of each hinge: 76 of the 12 segments, 111 of 17
    rest = len(message.state) - 12
    fits = any(rest == 7 * free + 2 * hinges for free in range(49) for hinges in range(49))
    expect(fits, f"a state of {len(message.state)} numbers")
    expect(len(message.deformed) == len(message.greatest_deformation_m), "deformations")
    expect(len(message.belt_normal_vehicle) == 3 * len(message.belt_greatest_elongation_m), "belts")
    touches = {
        len(values)
        for values in (
            message.first_touch_sphere,
            message.first_touch_surface,
            message.first_touch_time_s,
            message.first_touch_closing_m_s,
            message.first_touch_speed_m_s,
        )
    }
    expect(len(touches) == 1, "first touches")
    pairs = [*message.passed, *message.touching]
    expect(len(pairs) == len(set(pairs)), "a pair that touches and has passed")
    expect(max([*pairs, *message.deformed], default=-1) < message.pairs, "a pair that there is not")


def main(path):
    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        run, result = check_records(reader)
        compared = check_schemas(reader.get_summary())
        times = defaultdict(list)
        segments = []
        largest = defaultdict(float)
        for _, channel, record, message in reader.iter_decoded_messages():
            topic = channel.topic
            times[topic].append(record.log_time)
            expect(record.log_time == record.publish_time, topic)
            if topic == "/tf":
                segments = check_transforms(message, record.log_time)
            if topic.startswith(("/vehicle", "/occupant", "/belt", "/strap", "/bag", "/energy", "/solver", "/checkpoint")):
                check_numbers(topic, message)
                t_s = message.time_s - float(run["start_s"])
                expect(abs(t_s * 1e9 - record.log_time) <= 1, f"{topic}: time {message.time_s}")
            if topic == "/checkpoint":
                check_checkpoint(message)
            if topic.endswith("/segment/head"):
                largest[topic] = max(largest[topic], message.accelerometer_resultant_m_s2)
        outputs = int(result["outputs"])
        # that of a resumed run holds the outputs of the one before it, too
        begin_ns = 0
        expect(times["/checkpoint"][0] == begin_ns, "the first output is not where the run begins")
        for topic, own in times.items():
            if topic == "/log":
                continue
            expect(own == sorted(own), f"{topic} is not in the order of time")
            wanted = {1} if topic in ONCE else range(1, outputs + 1) if topic in FRAMES else {outputs}
            expect(len(own) in wanted, f"{topic}: {len(own)} messages of {outputs} outputs")
        for topic in FRAMES:
            expect(times[topic][0] == begin_ns, f"{topic} does not begin at the first output")
            if result["status"] == "completed":
                expect(times[topic][-1] == times["/energy"][-1], f"{topic} does not reach the end")
        for segment in segments:
            expect(topic_of(segment) in times, f"no topic of {segment}")
    head = max(largest.values(), default=0.0) / 9.80665
    print(
        f"{path}: {result['status']} at {result['time_s']} s, {len(times)} topics, "
        f"{sum(map(len, times.values()))} messages, head at most {head:.1f} g, "
        f"{len(compared)} types compared with Foxglove's"
    )


if __name__ == "__main__":
    main(sys.argv[1])

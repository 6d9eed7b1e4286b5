"""Sweeps into an emulator of S3: machines that share nothing, kills, and all that can be wrong with a store.

    python -m pip install 'moto[server]' boto3 pyarrow
    python object_store.py OCCUPANT [--kills 20] [--seed 1]       # built with --features object-store

The table must have the bits of a sweep into a folder; a range that is there is not computed again; what is wrong is said in
words, with its mend, and within the time that a store may take.
"""

import argparse
import http.server
import logging
import os
import random
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import boto3
from moto.server import ThreadedMotoServer

from recipes import table

ROOT = Path(__file__).resolve().parents[3]
SHARDS, MACHINES, LONGEST = 8, 3, 100
STUDY = """base = "{base}"
design = {{ kind = "latin_hypercube", samples = 400 }}
set = {{ "time.end" = "120 ms" }}
keep = [0, 100]
[[parameters]]
path = "joints.neck.damping"
range = {{ from = "10 in lbf s/rad", to = "40 in lbf s/rad" }}
"""


def expect(condition, words):
    if not condition:
        sys.exit(f"object_store: {words}")


class Trouble(http.server.BaseHTTPRequestHandler):
    """An endpoint that answers every request with one status, or not at all (0)."""

    protocol_version = "HTTP/1.1"
    status = 200

    def log_message(self, *_):
        pass

    def answer(self):
        if self.status == 0:
            time.sleep(2 * LONGEST)
            return
        body = b"<html>sign in</html>" if self.status == 200 else b"<?xml version='1.0'?><Error><Code>C</Code></Error>"
        self.send_response(self.status)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("ETag", '"1"')
        self.send_header("Last-Modified", "Wed, 01 Jan 2025 00:00:00 GMT")
        self.end_headers()
        self.wfile.write(body if self.command != "HEAD" else b"")

    do_GET = do_PUT = do_HEAD = answer


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("occupant", type=Path)
    arguments.add_argument("--kills", type=int, default=20)
    arguments.add_argument("--seed", type=int, default=1)
    given = arguments.parse_args()
    occupant, chance = given.occupant.resolve(), random.Random(given.seed)
    logging.getLogger("werkzeug").setLevel(logging.ERROR)
    server = ThreadedMotoServer(ip_address="127.0.0.1", port=0, verbose=False)
    server.start()
    host, port = server.get_host_and_port()
    endpoint = f"http://{host}:{port}"
    keys = {"AWS_ACCESS_KEY_ID": "key", "AWS_SECRET_ACCESS_KEY": "secret", "AWS_REGION": "us-east-1"}
    usual = {**os.environ, **keys, "AWS_ENDPOINT": endpoint, "AWS_ALLOW_HTTP": "true", "TOKEN": "of another program"}
    names = {"aws_access_key_id": "key", "aws_secret_access_key": "secret", "region_name": "us-east-1"}
    client = boto3.client("s3", endpoint_url=endpoint, **names)
    client.create_bucket(Bucket="bucket")
    with tempfile.TemporaryDirectory() as folder:
        at = Path(folder)
        (at / "study.toml").write_text(STUDY.format(base=ROOT / "scenarios/cart-lap.toml"))

        def start(words, **environment):
            changed = {key: value for key, value in {**usual, **environment}.items() if value is not None}
            return subprocess.Popen([occupant, *words.split()], cwd=at, env=changed, stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT, errors="replace")

        def done(words):
            child = start(words)
            said = child.communicate()[0]
            expect(child.returncode == 0, f"{words}: {said}")
            return said

        def shard(number, machine):
            return f"sweep study.toml -o s3://bucket/a/b --scratch m{machine} --shard {number}/{SHARDS} --threads 1"

        done("sweep study.toml -o one --quiet --shard 1/1")
        killed = 0
        for _ in range(50 * given.kills):
            if killed == given.kills:
                break
            child = start(shard(chance.randint(1, SHARDS), chance.randint(1, MACHINES)))
            try:
                child.wait(chance.uniform(0.02, 0.6))
            except subprocess.TimeoutExpired:
                child.kill()
                killed += 1
            child.communicate()
            if killed == given.kills // 2:
                # as if the machine of a finished range had never been: all of it is computed anew
                listed = client.list_objects_v2(Bucket="bucket", Prefix="a/b/parts/").get("Contents", [])
                for file in listed:
                    client.delete_object(Bucket="bucket", Key=file["Key"])
        expect(killed == given.kills, f"only {killed} kills")
        for number in range(1, SHARDS + 1):
            done(shard(number, number % MACHINES))
        before = {file["Key"]: file["ETag"] for file in client.list_objects_v2(Bucket="bucket")["Contents"]}
        for number in range(1, SHARDS + 1):
            expect("finished, in s3://bucket/a/b" in done(shard(number, 9)), f"shard {number} was computed again")
        after = {file["Key"]: file["ETag"] for file in client.list_objects_v2(Bucket="bucket")["Contents"]}
        expect(before == after, "a finished sweep has changed")
        expect("400 of 400 samples" in done("sweep status s3://bucket/a/b"), "the status is another one")
        done("sweep merge s3://bucket/a/b -o merged --quiet")
        expect(table(at / "merged") == table(at / "one"), "the table is another one")
        done("study report s3://bucket/a/b -o page.html")
        print(f"{given.kills} kills, {MACHINES} machines: same table")

        troubles = []

        def trouble(status):
            handler = type("Handler", (Trouble,), {"status": status})
            troubles.append(http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler))
            threading.Thread(target=troubles[-1].serve_forever, daemon=True).start()
            return f"http://127.0.0.1:{troubles[-1].server_port}"

        wrong = [
            ("s3://no-bucket/x", {}, "NoSuchBucket", "make the bucket"),
            ("s3://bucket/x", {"AWS_ENDPOINT": "http://127.0.0.1:9"}, "refused", "AWS_ENDPOINT"),
            ("s3://bucket/x", {"AWS_ENDPOINT": "nonsense"}, "`nonsense`", "https://"),
            ("s3://bucket/x", {"AWS_ALLOW_HTTP": None}, "URL scheme is not allowed", "AWS_ALLOW_HTTP=true"),
            ("s3://bucket/x", {"AWS_TIMEOUT": "soon"}, "soon", "mend that variable"),
            ("s3://bucket/x", {"AWS_ACCESS_KEY_ID": "a\nb"}, "AWS_ACCESS_KEY_ID", "set it anew"),
            ("s3://bucket/x", {"AWS_ENDPOINT": trouble(403)}, "privileges", "rights to read"),
            ("s3://bucket/x", {"AWS_ENDPOINT": trouble(503)}, "503", "same command again"),
            ("s3://bucket/x", {"AWS_ENDPOINT": trouble(200)}, "none of a sweep", "endpoint"),
            ("s3://bucket/x", {"AWS_ENDPOINT": trouble(0)}, "no answer within", "same command again"),
        ]
        for address, environment, found, mend in wrong:
            for words in (f"sweep study.toml -o {address} --scratch w --range 0..2 --quiet", f"sweep status {address}"):
                began, child = time.monotonic(), start(words, **environment)
                said = child.communicate()[0]
                is_said = child.returncode in (1, 2) and found in said and mend in said and "panicked" not in said
                expect(is_said, f"{environment}: exit code {child.returncode}, {said}")
                expect(time.monotonic() - began < LONGEST, f"{environment}: {time.monotonic() - began:.0f} s")
        print(f"{len(wrong)} stores with which something is wrong: all in words")
    server.stop()


if __name__ == "__main__":
    main()

"""Reads the tables of a sweep with pyarrow, pandas and DuckDB alone and compares them with each other.

    python -m pip install pyarrow duckdb pandas
    python read_table.py FOLDER          # of `occupant sweep STUDY -o FOLDER --csv`
    python read_table.py FOLDER OTHER    # whose parts are those of the sweep in OTHER
"""

import csv
import json
import sys
import zlib
from pathlib import Path

import duckdb
import pandas
import pyarrow.dataset as dataset
import pyarrow.parquet as parquet


def expect(condition, words):
    if not condition:
        sys.exit(f"read_table: {words}")


def number(text):
    return None if text == "" else float(text)


def check(folder):
    table = parquet.read_table(folder / "results.parquet")
    about = {key.decode(): value.decode() for key, value in table.schema.metadata.items()}
    sweep, units = json.loads(about["occupant.sweep"]), json.loads(about["occupant.units"])
    expect(table.num_rows == sweep["samples"], f"{table.num_rows} rows of {sweep['samples']}")
    expect(table["index"].to_pylist() == list(range(table.num_rows)), "rows out of order")
    columns = [column["name"] for column in sweep["columns"]]
    inputs = [column["name"] for column in sweep["columns"] if column["role"] != "figure"]
    frame = ["index", *inputs, "status", "reason", "caveats", *columns[len(inputs):], "wall_time_s", "kernel"]
    expect(table.column_names == frame, "columns other than the manifest's")
    expect(set(units) == set(columns), "a column without a unit")
    for text in sweep["texts"]:
        expect((folder / text["copy"]).exists(), f"no copy of {text['name']}")

    with open(folder / "results.csv", newline="", encoding="utf-8") as file:
        lines = list(csv.reader(file))
    expect(lines[0] == frame, "the header of the CSV table")
    expect(len(lines) == table.num_rows + 1, "the number of CSV rows")
    for at, name in enumerate(frame):
        there = table[name].to_pylist()
        here = [line[at] for line in lines[1:]]
        if name == "index" or name in ("status", "kernel"):
            same = [str(value) for value in there] == here
        elif table.schema.field(name).type == "double":
            same = there == [number(text) for text in here]
        else:
            same = [value or "" for value in there] == here
        expect(same, f"column {name} differs between Parquet and CSV")

    connection = duckdb.connect()
    path = str(folder / "results.parquet").replace("'", "''")
    counted = connection.execute(f"select status, count(*) from '{path}' group by status order by status").fetchall()
    there = table["status"].to_pylist()
    expect(dict(counted) == {status: there.count(status) for status in set(there)}, "DuckDB counts otherwise")
    # of the first body
    head = next(name for name in table.column_names if name.endswith("head.peak"))
    peak = connection.execute(f"select max(\"{head}\") from '{path}'").fetchall()[0][0]
    peaks = [value for value in table[head].to_pylist() if value is not None]
    expect(peak == max(peaks, default=None), f"DuckDB reads another greatest {head}")
    stored = connection.execute(f"select decode(value) from parquet_kv_metadata('{path}') where decode(key) = 'occupant.units'")
    expect(json.loads(stored.fetchall()[0][0]) == units, "DuckDB reads other units")
    print(f"read_table: {table.num_rows} rows, {table.num_columns} columns, {dict(counted)}")


def check_parts(folder, whole):
    """The parts are one table, that of the whole sweep but for wall times and kernels."""
    paths = sorted((folder / "parts").iterdir())
    expect(len(paths) > 1, "less than two parts")
    expected = parquet.read_table(whole / "results.parquet")
    same = [name for name in expected.column_names if name not in ("wall_time_s", "kernel")]
    table = dataset.dataset(folder / "parts", format="parquet").to_table().sort_by("index").select(same)
    expect(table.equals(expected.select(same)), "the parts are another table than the whole")
    expect(len(pandas.read_parquet(folder / "parts")) == table.num_rows, "pandas reads another number of rows")
    pattern = str(folder / "parts/*.parquet").replace("'", "''")
    counted = duckdb.connect().execute(f"select count(*), min(\"index\"), max(\"index\") from '{pattern}'").fetchall()
    expect(counted == [(table.num_rows, 0, table.num_rows - 1)], f"DuckDB reads {counted}")
    for path in paths:
        metadata = parquet.read_schema(path).metadata
        about = json.loads(metadata[b"occupant.part"])
        name = f"{about['first']:09}-{about['last']:09}.parquet"
        rows = parquet.read_table(path, columns=["index"])["index"].to_pylist()
        expect((path.name, rows) == (name, list(range(about["first"], about["last"] + 1))), f"{path.name} has other rows")
        data, end = path.read_bytes(), path.stat().st_size - 8
        end -= int.from_bytes(path.read_bytes()[-8:-4], "little")
        for key in ("crc32", "end_crc32"):
            data = data.replace(f'"{key}":"{about[key]}"'.encode(), f'"{key}":"00000000"'.encode())
        found = {"crc32": f"{zlib.crc32(data):08x}", "end_crc32": f"{zlib.crc32(data[end:]):08x}"}
        expect(found == {key: about[key] for key in found}, f"{path.name} has other checksums")
    print(f"read_table: {len(paths)} parts, {table.num_rows} rows")


if __name__ == "__main__":
    expect(len(sys.argv) in (2, 3), "usage: python read_table.py FOLDER [OTHER]")
    if len(sys.argv) == 3:
        check_parts(*map(Path, sys.argv[1:]))
    else:
        check(Path(sys.argv[1]))

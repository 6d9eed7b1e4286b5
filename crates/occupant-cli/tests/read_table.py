"""Reads the tables of a sweep with pyarrow and DuckDB alone and compares them with each other.

    python -m pip install pyarrow duckdb
    python read_table.py FOLDER          # of `occupant sweep STUDY -o FOLDER --csv`
"""

import csv
import json
import sys
from pathlib import Path

import duckdb
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


if __name__ == "__main__":
    expect(len(sys.argv) == 2, "usage: python read_table.py FOLDER")
    check(Path(sys.argv[1]))

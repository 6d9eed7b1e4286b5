"""Reads exports with independent Python packages and compares them with each other.

    python -m pip install pandas pyarrow duckdb pyisomme
    occupant export RUN.mcap -o out.csv
    occupant export RUN.mcap -o out.parquet
    occupant export RUN.mcap -o T1.mme --interval '1 ms'
    python read_histories.py FOLDER
"""

import json
import sys
from pathlib import Path

import duckdb
import numpy
import pandas
import pyarrow.parquet
import pyisomme

folder = Path(sys.argv[1])


def expect(condition, words):
    if not condition:
        sys.exit(f"read_histories: {words}")


table = pandas.read_csv(folder / "out.csv", float_precision="round_trip")
expect(all(kind.kind in "fi" for kind in table.dtypes), "a column of the CSV is not numbers")
about = json.loads((folder / "out.csv-metadata.json").read_text())
columns = about["tableSchema"]["columns"]
expect([c["titles"] for c in columns] == list(table.columns), "the metadata names other columns")

parquet = pyarrow.parquet.read_table(folder / "out.parquet")
named = json.loads(parquet.schema.metadata[b"occupant"])["columns"]
expect([c["name"] for c in named] == parquet.column_names, "the Parquet metadata names other columns")
for title, name in zip(table.columns, parquet.column_names):
    same = numpy.allclose(table[title], parquet[name].to_numpy(), rtol=0, atol=1e-9 if name == "time" else 0)
    expect(same, f"{name} differs between CSV and Parquet")
file = str(folder / "out.parquet")
peak = duckdb.sql(f'select max("head.acceleration.resultant") from read_parquet(\'{file}\')').fetchall()[0][0]
expect(peak == table["head.acceleration.resultant[m/s^2]"].max(), "DuckDB sees another peak")

test = pyisomme.Isomme().read(folder / "T1" / "T1.mme")
expect(len(test.channels) > 20, f"pyisomme reads {len(test.channels)} channels")
signs = {
    "head.acceleration.x": ("11HEADCG0000ACX0", 1),
    "head.acceleration.y": ("11HEADCG0000ACY0", -1),
    "head.acceleration.z": ("11HEADCG0000ACZ0", -1),
    "neck.force.z": ("11NECKUP0000FOZ0", 1),
    "vehicle.acceleration.x": ("10VEHCCG0000ACX0", 1),
    "belt.lap.force": ("11SEBE0000B6FO00", 1),
}
for name, (code, sign) in signs.items():
    channel = test.get_channel(code)
    expect(channel is not None, f"pyisomme finds no {code}")
    theirs = channel.data.iloc[:, 0]
    ours = numpy.interp(theirs.index, table["time[s]"], table[[c for c in table if c.startswith(name + "[")][0]])
    expect(numpy.allclose(sign * theirs, ours, rtol=1e-9, atol=1e-9), f"{code} is not {name}")
    print(code, name, channel.unit, f"peak {abs(theirs).max():.6g}")
print(f"{len(table)} rows, {len(columns)} columns, {len(test.channels)} ISO-MME channels: all agree")

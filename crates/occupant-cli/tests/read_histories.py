"""Reads exports with independent Python packages and compares them with each other.

    python -m pip install pandas pyarrow duckdb pyisomme openpyxl scipy
    occupant export RUN.mcap -o out.csv
    occupant export RUN.mcap -o out.parquet
    occupant export RUN.mcap -o out.xlsx
    occupant export RUN.mcap -o out.mat
    occupant export RUN.mcap -o T1.mme --interval '1 ms'
    python read_histories.py FOLDER
"""

import json
import sys
from pathlib import Path

import duckdb
import numpy
import openpyxl
import pandas
import pyarrow.parquet
import pyisomme
import scipy.io

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

book = openpyxl.load_workbook(folder / "out.xlsx", read_only=True)
expect(book.sheetnames == ["table", "measures", "columns", "about"], f"openpyxl sees the sheets {book.sheetnames}")
head, *rows = book["table"].iter_rows(values_only=True)
expect(list(head) == list(table.columns), "the sheet has other headings")
expect(numpy.array_equal(numpy.array(rows, float), table.to_numpy(), equal_nan=True), "the sheet has other numbers")
head, *measures = book["measures"].iter_rows(values_only=True)
expect(head == ("name", "value", "unit") and len(measures) > 50, f"{len(measures)} measures, {head}")
sheet = {name: (value, unit) for name, value, unit in measures}
known = [(c["name"], c["unit"], c["dc:description"]) for c in columns]
rows = list(book["columns"].iter_rows(min_row=2, values_only=True))
expect([(name, unit, meaning) for name, unit, _, _, meaning in rows] == known, "the sheet of columns is another")

matlab = scipy.io.loadmat(folder / "out.mat", squeeze_me=True, struct_as_record=False)
for name in parquet.column_names:
    expect(numpy.array_equal(matlab[name.replace(".", "_")], parquet[name].to_numpy()), f"{name} differs in MATLAB")
expect(list(matlab["columns"].unit) == [unit for _, unit, _ in known], "MATLAB sees other units")
expect(list(matlab["columns"].meaning) == [meaning for *_, meaning in known], "MATLAB sees other words")
for name, value, unit in zip(matlab["measures"].name, matlab["measures"].value, matlab["measures"].unit):
    same = value == sheet[name][0] or (numpy.isnan(value) and sheet[name][0] is None)
    expect(same and unit == sheet[name][1], f"the measure {name} is {value} {unit} here and {sheet[name]} there")
print(f"head.peak {sheet['head.peak']}, hic15 {sheet['hic15']}")

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

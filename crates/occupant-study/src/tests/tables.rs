//! Samples from a CSV file.

use super::super::{StudyText, Value};
use super::base;
use occupant_scenario::{Diagnostics, Format};

const STUDY: &str = "base = \"short.toml\"
design = { kind = \"table\", file = \"samples.csv\" }

[[parameters]]
name = \"damping\"
path = \"joints.*.damping\"
apply = \"factor\"
";

fn with(csv: &str) -> Result<super::Study, Diagnostics> {
    let text = StudyText::read(STUDY, Format::Toml, "study.toml").unwrap();
    text.bind(base(), &[], &|file| match file {
        "samples.csv" => Ok(csv.as_bytes().to_vec()),
        _ => Err("not there".into()),
    })
}

#[test]
fn a_table_gives_the_samples_row_by_row() {
    let study = with("# ours\nbelts.lap.slack[mm], damping, path.shape\n\n10, 1, square\n25.4, 0.5, half_sine\n");
    let study = study.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(study.len(), 2);
    let names: Vec<&str> = study.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["damping", "belts.lap.slack", "path.shape"]);
    let row: Vec<Value> = study.sample(1).into_iter().map(|s| s.value).collect();
    let wanted = [Value::Number(0.5), Value::Number(0.0254), Value::Text("half_sine".into())];
    assert_eq!(row, wanted);
    assert_eq!(study.assignments(1).len(), 13);
}

#[test]
fn everything_wrong_with_a_table_is_told_at_once() {
    let words = with("belts.lap.slck[mm], path.shape, posture.head\n1, sine, 2\n1, square\n").unwrap_err();
    assert_eq!(
        words.to_string(),
        r#"error: `belts.lap` has nothing named `slck`
 --> samples.csv:1:1
  = help: did you mean `slack`?
  = expected: the name of a parameter, or a path: one of anchor, anchors, buckle, d_ring, d_ring_frame, delta_b, k1, k2, lap, lap_above, length, limiter, locking_tongue, mu1, mu2, nodes, preset, pretension, pretensioner, release, retractor, side, slack, sphere, strength, webbing, worn

error: column `posture.head` without a unit
 --> samples.csv:1:33
  = expected: the unit of an angle in brackets, such as `posture.head[deg]`

error: no column `damping`
 --> samples.csv:1:1
  = expected: one column per parameter

error: `sine`
 --> samples.csv:2:4
  = expected: "half_sine", "haversine", "triangle", "trapezoid", "square" or "tabulated"

error: 2 values
 --> samples.csv:3:1
  = expected: 3, one for each column"#
    );
    let none = with("damping\n").unwrap_err().to_string();
    assert!(none.contains("a table without samples"), "{none}");
    let empty = with("").unwrap_err().to_string();
    assert!(empty.contains("an empty table"), "{empty}");
}

/// Columns of a Parquet file with these values: numbers, or words; NaN and an empty word are missing.
fn parquet(columns: &[(&str, Column)]) -> Vec<u8> {
    use parquet::basic::{LogicalType, Repetition, Type as Physical};
    use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;
    let field = |(name, column): &(&str, Column)| {
        let (physical, logical) = match column {
            Column::Numbers(_) => (Physical::DOUBLE, None),
            Column::Counts(_) => (Physical::INT64, None),
            Column::Words(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        };
        let built = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        built.with_logical_type(logical).build().unwrap().into()
    };
    let fields = columns.iter().map(field).collect();
    let schema = Type::group_type_builder("t").with_fields(fields).build().unwrap().into();
    let properties = WriterProperties::builder().build().into();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, properties).unwrap();
    // two groups of rows
    for half in 0..2 {
        let mut group = writer.next_row_group().unwrap();
        for (_, column) in columns {
            let mut out = group.next_column().unwrap().unwrap();
            let part = |len: usize| if half == 0 { 0..len / 2 } else { len / 2..len };
            match column {
                Column::Numbers(all) => {
                    let all = &all[part(all.len())];
                    let levels: Vec<i16> = all.iter().map(|x| i16::from(!x.is_nan())).collect();
                    let there: Vec<f64> = all.iter().copied().filter(|x| !x.is_nan()).collect();
                    out.typed::<DoubleType>().write_batch(&there, Some(&levels), None).unwrap();
                }
                Column::Counts(all) => {
                    let all = &all[part(all.len())];
                    out.typed::<Int64Type>().write_batch(all, Some(&vec![1; all.len()]), None).unwrap();
                }
                Column::Words(all) => {
                    let all: Vec<ByteArray> = all[part(all.len())].iter().map(|word| (*word).into()).collect();
                    out.typed::<ByteArrayType>().write_batch(&all, Some(&vec![1; all.len()]), None).unwrap();
                }
            }
            out.close().unwrap();
        }
        group.close().unwrap();
    }
    writer.into_inner().unwrap()
}

#[derive(Clone)]
enum Column {
    Numbers(Vec<f64>),
    Counts(Vec<i64>),
    Words(Vec<&'static str>),
}

fn with_parquet(bytes: &[u8]) -> Result<super::Study, Diagnostics> {
    let text = STUDY.replace("samples.csv", "samples.parquet");
    let text = StudyText::read(&text, Format::Toml, "study.toml").unwrap();
    text.bind(base(), &[], &|_| Ok(bytes.to_vec()))
}

#[test]
fn a_parquet_file_gives_the_samples_of_the_csv_file() {
    let csv = "belts.lap.slack[mm], damping, path.shape\n10, 1, square\n25.4, 2, half_sine\n3, 4, square\n";
    let columns = [
        ("belts.lap.slack[mm]", Column::Numbers(vec![10.0, 25.4, 3.0])),
        ("damping", Column::Counts(vec![1, 2, 4])),
        ("path.shape", Column::Words(vec!["square", "half_sine", "square"])),
    ];
    let [one, other] =
        [with(csv), with_parquet(&parquet(&columns))].map(|study| study.unwrap_or_else(|e| panic!("{e}")));
    assert_eq!([one.len(), other.len()], [3, 3]);
    (0..3).for_each(|sample| assert_eq!(one.sample(sample), other.sample(sample)));
    assert_eq!(other.sample(2)[2].value, Value::Text("square".into()));
}

#[test]
fn what_is_wrong_with_a_parquet_file_is_told_with_its_column_and_row() {
    let said = |columns: &[(&str, Column)]| with_parquet(&parquet(columns)).unwrap_err().to_string();
    let damping = ("damping", Column::Numbers(vec![1.0, 2.0]));
    let words = said(&[damping.clone(), ("path.shape", Column::Words(vec!["square", "sine"]))]);
    assert!(words.contains("`\"sine\"` in row 2") && words.contains("samples.parquet, columns:2:1"), "{words}");
    let missing = said(&[("damping", Column::Numbers(vec![1.0, f64::NAN]))]);
    assert!(missing.contains("`null` in row 2") && missing.contains("a number"), "{missing}");
    let infinite = said(&[("damping", Column::Numbers(vec![f64::INFINITY, 1.0]))]);
    assert!(infinite.contains("in row 1"), "{infinite}");
    let text = said(&[("damping", Column::Words(vec!["1", "2"]))]);
    assert!(text.contains("in row 1") && text.contains("a number"), "{text}");
    let unit = said(&[damping.clone(), ("posture.head", Column::Numbers(vec![1.0, 2.0]))]);
    assert!(unit.contains("without a unit"), "{unit}");
    let twice = said(&[damping.clone(), ("damping", Column::Numbers(vec![1.0, 2.0]))]);
    assert!(twice.contains("two columns for `damping`"), "{twice}");
    let lines = said(&[damping, ("a\nb", Column::Numbers(vec![1.0, 2.0]))]);
    assert!(lines.contains("one of several lines"), "{lines}");
    let none = said(&[("damping", Column::Numbers(Vec::new()))]);
    assert!(none.contains("a table without samples"), "{none}");
}

/// No byte of a damaged file is a panic.
#[test]
fn a_damaged_parquet_file_is_refused_or_read() {
    let whole = parquet(&[
        ("damping", Column::Numbers((0..40).map(f64::from).collect())),
        ("path.shape", Column::Words(vec!["square"; 40])),
    ]);
    let mut refused = 0;
    for at in 4..whole.len() {
        for bits in [0x01, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] ^= bits;
            refused += usize::from(with_parquet(&damaged).is_err());
        }
        let cut = with_parquet(&whole[..at]).unwrap_err().to_string();
        assert!(cut.contains("cannot be read"), "{cut}");
    }
    assert!(refused > whole.len() / 4, "{refused}");
}

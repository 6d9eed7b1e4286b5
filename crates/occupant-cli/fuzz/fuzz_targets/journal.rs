//! A file of a study's folder is other than it was written. The first byte says which: rows of the journal, whose head and
//! checksums are made to fit; a whole piece of the journal; the manifest; the list of checksums; the copy of the study.
#![no_main]

use std::fs;
use std::sync::OnceLock;

use commands::{folder, give, study, write};
use libfuzzer_sys::fuzz_target;

const DESIGN: &str = "[design]\nkind = \"latin_hypercube\"\nsamples = 3\n[[parameters]]\nname = \"friction\"\n\
    path = \"materials.seat.friction\"\nrange = { from = 0.2, to = 1 }\n";
const PIECE: &str = "out/journal/shard-0001-of-0001.000000.rows";
const FILES: [&str; 5] = [PIECE, PIECE, "out/sweep.json", "out/SHA256SUMS", "out/inputs/0-study.toml"];

/// The files of a folder that is whole.
static WHOLE: OnceLock<Vec<(String, Vec<u8>)>> = OnceLock::new();

fn whole() -> Vec<(String, Vec<u8>)> {
    folder();
    write("study.toml", study(DESIGN).as_bytes());
    give(&["sweep study.toml -o out -q --threads 1"]);
    let inputs = fs::read_dir("out/inputs").expect("the sweep has made it").flatten().map(|f| f.path());
    let inputs = inputs.map(|path| path.to_string_lossy().into_owned());
    let names = FILES.iter().skip(1).map(|name| (*name).to_owned()).chain(inputs);
    names.map(|name| (fs::read(&name).expect("the sweep has written it"), name)).map(|(b, n)| (n, b)).collect()
}

fuzz_target!(|bytes: &[u8]| {
    let whole = WHOLE.get_or_init(whole);
    let Some((which, bytes)) = bytes.split_first() else { return };
    let _not_there = fs::remove_dir_all("out");
    for folder in ["out/inputs", "out/journal"] {
        fs::create_dir_all(folder).expect("room in the folder for temporary files");
    }
    for (name, content) in whole {
        write(name, content);
    }
    let which = usize::from(*which) % FILES.len();
    match which {
        0 => {
            let head = whole[0].1.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default();
            write(PIECE, &[head, &summed(bytes)].concat());
        }
        _ => write(FILES[which], bytes),
    }
    // a piece that differs from what is listed is not read
    if which < 2 {
        let _not_there = fs::remove_file("out/SHA256SUMS");
    }
    give(&["study report out -o page.html -f", "sweep merge out --csv", "sweep study.toml -o out -q --threads 1"]);
});

/// Rows as lines of the journal.
fn summed(rows: &[u8]) -> Vec<u8> {
    let line = |row: &[u8]| match row.strip_suffix(b"\n") {
        Some(row) => [format!("{{\"crc32\":\"{:08x}\",\"is\":", crc32fast::hash(row)).as_bytes(), row, b"}\n"].concat(),
        None => row.to_vec(),
    };
    rows.split_inclusive(|byte| *byte == b'\n').flat_map(line).collect()
}

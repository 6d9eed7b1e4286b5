//! What stands on a page, of studies of all kinds and at any time of their life.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::{STUDY, answer, done, err, folder_with, occupant, page, spoken, swept};

/// Rows of a Parquet file: column by name, as text.
fn rows(file: &Path) -> Vec<Vec<(String, Field)>> {
    let file = fs::File::open(file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
    let reader = SerializedFileReader::new(file).unwrap();
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|r| r.unwrap().into_columns()).collect()
}

fn text<'a>(row: &'a [(String, Field)], name: &str) -> &'a str {
    match row.iter().find(|c| c.0 == name) {
        Some((_, Field::Str(text))) => text,
        other => panic!("{name}: {other:?}"),
    }
}

fn number(row: &[(String, Field)], name: &str) -> Option<f64> {
    match row.iter().find(|c| c.0 == name) {
        Some((_, Field::Double(x))) => Some(*x),
        Some((_, Field::Null)) => None,
        other => panic!("{name}: {other:?}"),
    }
}

/// How often a quantity stands in the table of numbers, and how often marked.
fn counted(at: &Path, quantity: &str) -> (usize, usize) {
    let rows = rows(&at.join("out/report.parquet"));
    let ours: Vec<_> = rows.iter().filter(|r| text(r, "quantity") == quantity).collect();
    let marked = ours.iter().filter(|r| !text(r, "mark").is_empty());
    (ours.len(), marked.count())
}

/// A page that is whole: every element that is opened is closed, nothing is fetched, nothing is `NaN`.
#[track_caller]
fn sane(page: &str) {
    for tag in ["svg", "table", "section", "figure", "pre", "h2", "div", "tr", "td"] {
        let opened = page.matches(&format!("<{tag} ")).count() + page.matches(&format!("<{tag}>")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "<{tag}>");
    }
    for word in ["<script", "src=", "<link", "url(", "@import", "NaN", "inf "] {
        assert!(!page.contains(word), "{word}");
    }
    // the name space of SVG is no address that is fetched
    let addresses = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!addresses.contains("http://") && !addresses.contains("https://"));
}

#[test]
fn a_finished_study_has_all_its_sections() {
    let folder = swept(STUDY);
    let at = folder.path();
    let text = page(at);
    sane(&text);
    for words in [
        "damping &lt;and&gt; speed",
        "Latin hypercube of 24 samples",
        "joints.neck.damping",
        "24 of 24 runs finished",
        "Rank correlation and standardised regression",
        "Over each parameter",
        "Over two parameters",
        "Worst and best runs",
        "SHA-256",
        "is unreliable",
    ] {
        assert!(text.contains(words), "{words}");
    }
    let samples = rows(&at.join("out/report-samples.parquet"));
    assert_eq!(samples.len(), 24);
    let speed = number(&samples[5], "input.speed").unwrap();
    assert!((6.7..11.2).contains(&speed), "{speed}");
    let (ranks, marked) = counted(at, "rank_correlation");
    // 24 rows are enough to rank
    assert!(ranks >= 2 && ranks % 2 == 0 && marked == 0, "{ranks} {marked}");
}

#[test]
fn figures_with_caveats_are_marked_where_they_stand() {
    // steps of 0.75 ms are too long, though no run loses its energy balance: then its figures would not count
    let study = STUDY
        .replace("\"30 ms\"", "\"120 ms\"")
        .replace("\"0.5 ms\"", "\"10 ms\", \"integrator.step\" = \"0.75 ms\"")
        .replace("samples = 24", "samples = 6");
    let folder = swept(&study);
    let shown = page(folder.path());
    sane(&shown);
    assert!(shown.contains(" of 6 runs have caveats on this result: "), "{shown}");
    let mut ends = shown.lines().filter(|line| line.contains(", greatest: "));
    assert!(ends.any(|line| line.contains(" †: ") && line.contains("readings_too_coarse")), "{shown}");
    let rows = rows(&folder.path().join("out/report.parquet"));
    // measured: too coarse in 4 of the 6 runs
    let figure = "chest.three_ms_cumulative";
    let median = rows.iter().find(|r| text(r, "response") == figure && text(r, "quantity") == "median").unwrap();
    assert!(text(median, "mark").contains("readings_too_coarse"), "{}", text(median, "mark"));
    // the table says which figures
    let table = fs::read_to_string(folder.path().join("out/results.csv")).unwrap();
    let mut coarse = table.split("readings_too_coarse(").skip(1).filter_map(|rest| rest.split(')').next());
    assert!(coarse.any(|figures| figures.split(';').any(|name| name == figure)), "{table}");
}

#[test]
fn parameters_that_go_together_are_named() {
    let study = format!("{STUDY}\n[[correlations]]\nbetween = [\"joints.neck.damping\", \"speed\"]\nrank = 0.9\n");
    let folder = swept(&study);
    done(folder.path(), &["study", "report", "out"]);
    let text = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(
        text.contains("joints.neck.damping and speed together (rank correlation 0.")
            || text.contains("joints.neck.damping and speed together (rank correlation 1.")
    );
    assert!(!page(swept(STUDY).path()).contains("together (rank"));
}

#[test]
fn figures_can_be_chosen_and_constant_ones_say_so() {
    let folder = swept(STUDY);
    let at = folder.path();
    let words = ["study", "report", "out", "-o", "chosen.html", "--to", "contacts.head.peak,belts.*.peak"];
    done(at, &words);
    let shown = fs::read_to_string(at.join("chosen.html")).unwrap();
    sane(&shown);
    assert!(shown.contains("belts.torso.peak") && !shown.contains(">hic15<"));
    // the head touches nothing in 30 ms
    assert!(shown.contains("The same in all 24 samples: 0 N."), "{shown}");
    let rows = rows(&at.join("chosen.parquet"));
    assert!(rows.iter().all(|r| text(r, "response") != "hic15"));
}

#[test]
fn a_growing_study_says_how_much_of_it_is_there() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    done(at, &["sweep", "study.toml", "-o", "out", "--quiet", "--shard", "1/2"]);
    let said = spoken(at, &["study", "report", "out"]);
    assert!(said.contains("not finished: 12 of 24 runs"), "{said}");
    let text = fs::read_to_string(at.join("out/report.html")).unwrap();
    sane(&text);
    assert!(text.contains("12 of 24 runs finished"));
    // twelve rows are too few for what is read from them
    let (ranks, marked) = counted(at, "rank_correlation");
    assert!(ranks > 0 && marked == ranks, "{ranks} {marked}");
    // a row that was being written when the other process was killed
    let piece = at.join("out/journal/000000012-000000023.000000.rows");
    fs::write(piece, "{\"crc32\":\"").unwrap();
    let said = spoken(at, &["study", "report", "out", "--force"]);
    assert!(said.contains("not finished: 12 of 24 runs"), "{said}");
}

#[test]
fn a_sweep_at_work_and_a_killed_one_can_be_reported_on() {
    let folder = folder_with(&STUDY.replace("samples = 24", "samples = 2000"));
    let at = folder.path();
    let mut sweep = occupant(at)
        .args(["sweep", "study.toml", "-o", "out", "--quiet", "--threads", "1"])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // while it is at work, and after it was killed
    for _ in 0..600 {
        std::thread::sleep(Duration::from_millis(50));
        let journal = fs::read_dir(at.join("out/journal")).into_iter().flatten();
        let bytes: u64 = journal.map(|e| e.unwrap().metadata().unwrap().len()).sum();
        if bytes > 20_000 {
            break;
        }
    }
    let text = page(at);
    sane(&text);
    sweep.kill().unwrap();
    sweep.wait().unwrap();
    sane(&page(at));
}

#[test]
fn a_study_of_which_nothing_is_finished_has_a_page_that_says_so() {
    let folder = swept(STUDY);
    let at = folder.path();
    fs::remove_file(at.join("out/results.parquet")).unwrap();
    let text = page(at);
    sane(&text);
    assert!(text.contains("No run has finished yet"));
}

#[test]
fn failed_and_refused_runs_are_counted_with_their_reasons() {
    let study = r#"
        design.kind = "full_factorial"
        set = { "time.end" = "20 ms" }
        [[parameters]]
        path = "time.start"
        list = [0.0, 0.5]
        [[parameters]]
        path = "path.duration"
        grid = { from = "60 ms", to = "100 ms", steps = 12 }
    "#;
    let folder = swept(study);
    let text = page(folder.path());
    sane(&text);
    assert!(text.contains("refused") && text.contains("an end after the start"));
    assert!(text.contains("12 of 24 runs have no valid results"));
    assert!(text.contains("12 of 24 samples lack this result"));
    // half of the runs are missing: what is said of the rest is marked
    let (median, marked) = counted(folder.path(), "median");
    assert!(median > 0 && marked == median);
    assert!(text.contains("samples lack this result: the statements apply only to the others\">"));
}

#[test]
fn one_parameter_thirty_parameters_and_words_give_a_page() {
    let one = r#"
        design.kind = "full_factorial"
        set = { "time.end" = "15 ms" }
        [[parameters]]
        path = "path.shape"
        list = ["half_sine", "haversine", "triangle", "square"]
    "#;
    let folder = swept(one);
    let text = page(folder.path());
    sane(&text);
    assert!(text.contains("words have no order") && text.contains("haversine"));

    let joints = ["neck", "upper_back", "lower_back"];
    let mut many =
        "set = { \"time.end\" = \"3 ms\" }\ndesign = { kind = \"latin_hypercube\", samples = 80 }\n".to_owned();
    for i in 0..30 {
        let joint = joints[i % 3];
        many += &format!(
            "[[parameters]]\nname = \"parameter number {i} of many\"\npath = \"joints.{joint}.damping\"\napply = \"factor\"\nrange = {{ from = 0.9, to = 1.1 }}\n"
        );
    }
    let folder = swept(&many);
    let at = folder.path();
    let words = ["study", "report", "out", "--to", "energy.greatest_kinetic,head.peak"];
    done(at, &words);
    let text = fs::read_to_string(at.join("out/report.html")).unwrap();
    sane(&text);
    assert!(text.contains("The 9 most important of 30"));
    let (coefficients, marked) = counted(at, "regression_coefficient");
    // 80 rows of 30 parameters are fewer than ten each
    assert!(coefficients >= 30 && marked == coefficients, "{coefficients} {marked}");
    assert!(text.len() < 2_000_000, "{}", text.len());
}

#[test]
fn each_design_has_its_own_table() {
    let parameters = r#"
        [[parameters]]
        path = "path.speed"
        range = { from = "15 mph", to = "25 mph" }
        [[parameters]]
        path = "path.shape"
        list = ["half_sine", "square"]
    "#;
    let designs = [
        ("saltelli\", samples = 16, second_order = true", "Sobol indices", "sobol_total"),
        ("saltelli\", samples = 4", "too few values", "median"),
        ("morris\", trajectories = 5", "elementary effects", "morris_sigma"),
        ("morris\", trajectories = 2", "too few values", "median"),
        ("one_at_a_time\"", "One parameter at a time", "alone_nominal"),
    ];
    for (design, words, quantity) in designs {
        let head = format!("set = {{ \"time.end\" = \"12 ms\" }}\ndesign = {{ kind = \"{design} }}\n");
        let folder = swept(&(head + parameters));
        let text = page(folder.path());
        sane(&text);
        assert!(text.contains(words), "{design}");
        assert!(counted(folder.path(), quantity).0 > 0, "{design}");
    }
}

/// Numbers after each place of `before`.
fn numbers_after(text: &str, before: &str) -> Vec<f64> {
    let number = |rest: &str| rest.split(|c: char| !(c.is_ascii_digit() || "-.".contains(c))).next()?.parse().ok();
    text.split(before).skip(1).filter_map(number).collect()
}

/// Thirty parameters: each has a label, and every dot stands between the first and the last.
#[test]
fn a_plot_of_effects_has_all_parameters_inside_its_frame() {
    let joints = ["neck", "upper_back", "lower_back"];
    let mut study = "set = { \"time.end\" = \"5 ms\" }\ndesign = { kind = \"morris\", trajectories = 5 }\n".to_owned();
    for i in 0..30 {
        let joint = joints[i % 3];
        study += &format!(
            "[[parameters]]\nname = \"p{i}\"\npath = \"joints.{joint}.damping\"\napply = \"factor\"\nrange = {{ from = 0.9, to = 1.1 }}\n"
        );
    }
    let folder = swept(&study);
    done(folder.path(), &["study", "report", "out", "--to", "energy.greatest_kinetic"]);
    let text = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    sane(&text);
    let plots = text.split("<svg").find(|svg| svg.contains("Elementary effects over the whole range")).unwrap();
    let svg = plots.split("</svg>").next().unwrap();
    let labels: Vec<&str> = svg.split("<text").filter(|of| (0..30).any(|i| of.contains(&format!(">p{i}<")))).collect();
    assert_eq!(labels.len(), 30);
    let places: Vec<f64> = labels.iter().flat_map(|label| numbers_after(label, " y=\"")).collect();
    let ends = [places[0], places[29]];
    let dots: Vec<f64> = svg
        .split("d=\"M")
        .skip(1)
        .filter(|path| path.contains("h.01"))
        .flat_map(|path| {
            let data = path.split('"').next().unwrap();
            data.split('M').flat_map(|dot| numbers_after(dot, " ")).collect::<Vec<_>>()
        })
        .collect();
    let inside = dots.iter().filter(|y| **y > ends[0] - 20.0 && **y < ends[1] + 10.0).count();
    assert_eq!((dots.len(), inside), (62, 60), "μ* and σ of each, and the two of the legend below: {ends:?} {dots:?}");
}

/// The table of what matters: the most important parameter first, on the darkest shade.
#[test]
fn the_matrix_is_sorted_and_shaded_and_pairs_have_their_table() {
    let [head, damping, speed] = STUDY.split("[[parameters]]").collect::<Vec<_>>()[..] else { panic!("{STUDY}") };
    let turned = format!("{head}[[parameters]]{speed}\n[[parameters]]{damping}");
    let folder = swept(&turned.replace("samples = 24", "samples = 60"));
    let text = page(folder.path());
    let matrix = text.split("What matters for which result").nth(1).unwrap().split("</table>").next().unwrap();
    let shades = numbers_after(matrix, "shade-");
    let lines: Vec<&str> = matrix.split("<tr>").skip(2).collect();
    assert!(lines.len() == 2 && lines[0].contains("<td>joints.neck.damping</td>"), "{matrix}");
    assert!(shades[0] == 5.0 && shades.iter().all(|shade| (1.0..=5.0).contains(shade)), "{shades:?}");

    let pairs = STUDY.replace("latin_hypercube\", samples = 24", "saltelli\", samples = 16, second_order = true");
    let folder = swept(&pairs);
    let text = page(folder.path());
    sane(&text);
    assert!(text.contains("Second-order Sobol indices") && text.contains("joints.neck.damping × speed"));
    let numbers = rows(&folder.path().join("out/report.parquet"));
    let second: Vec<_> = numbers.iter().filter(|row| self::text(row, "quantity") == "sobol_second").collect();
    assert!(!second.is_empty());
    assert!(second.iter().all(|row| self::text(row, "parameter") == "joints.neck.damping × speed"));
}

#[test]
fn an_ensemble_without_parameters_has_a_page() {
    let study = "set = { \"time.end\" = \"15 ms\" }\n[ensemble]\nmembers = 4\n";
    let folder = swept(study);
    let text = page(folder.path());
    sane(&text);
    assert!(text.contains("no parameter to analyse") && text.contains("Worst and best runs"));
}

#[test]
fn shards_in_several_folders_are_one_study() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    for (shard, out) in [("1/2", "a"), ("2/2", "b")] {
        done(at, &["sweep", "study.toml", "-o", out, "--quiet", "--shard", shard]);
    }
    done(at, &["study", "report", "a", "b", "-o", "both.html"]);
    let text = fs::read_to_string(at.join("both.html")).unwrap();
    assert!(text.contains("24 of 24 runs finished"));
    let other = swept(&STUDY.replace("seed = 3", "seed = 4"));
    let theirs = other.path().join("out");
    let output = answer(at, &["study", "report", "a", theirs.to_str().unwrap(), "-o", "no.html"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("different sweeps"), "{}", err(&output));
}

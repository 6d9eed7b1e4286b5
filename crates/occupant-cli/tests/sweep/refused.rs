//! What a sweep does not do.

use std::fs;

use super::{STUDY, answer, done, err, folder_with};

#[test]
fn another_study_in_the_same_folder_is_refused_and_the_difference_named() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    let words = ["sweep", "study.toml", "-o", "out", "--quiet"];
    done(at, &words);
    let table = fs::read(at.join("out/results.parquet")).unwrap();
    let refused = |words: &[&str]| {
        let output = answer(at, words);
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        err(&output)
    };
    let said = refused(&[&words[..], &["--set", "path.duration=70 ms"]].concat());
    assert!(said.contains("--set: none → path.duration=70 ms"), "{said}");
    fs::write(at.join("study.toml"), STUDY.replace("25 mph", "26 mph")).unwrap();
    let said = refused(&words);
    assert!(said.contains("study.toml, line 17: ") && said.contains("26 mph"), "{said}");
    assert!(said.contains("--restart"), "{said}");
    fs::write(at.join("study.toml"), STUDY).unwrap();
    let case = fs::read_to_string(at.join("case.toml")).unwrap();
    let other = case.replacen("[time]", "[time] # as in the report\n", 1);
    fs::write(at.join("case.toml"), other.replacen("end", "end ", 1)).unwrap();
    fs::write(at.join("study.toml"), format!("# a comment\n\n{}", STUDY.replace("seed = 3", "seed=3"))).unwrap();
    assert!(fs::read_to_string(at.join("case.toml")).unwrap() != case);
    done(at, &words);
    fs::write(at.join("case.toml"), case.replacen("title = \"", "title = \"x", 1)).unwrap();
    assert!(refused(&words).contains("case.toml, line "));
    fs::write(at.join("study.toml"), STUDY.replace("samples = 24", "samples = 48")).unwrap();
    fs::write(at.join("case.toml"), case).unwrap();
    let said = refused(&words);
    assert!(said.contains("samples: 24 → 48 (a Latin hypercube of another size has other samples)"), "{said}");
    fs::write(at.join("study.toml"), STUDY).unwrap();
    // nothing of that has touched the results
    assert_eq!(fs::read(at.join("out/results.parquet")).unwrap(), table);
    done(at, &[&words[..], &["--restart"]].concat());
}

#[test]
fn a_folder_with_other_files_is_left_alone() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    fs::create_dir(at.join("out")).unwrap();
    fs::write(at.join("out/thesis.tex"), "years of work").unwrap();
    for more in [&[][..], &["--restart"]] {
        let words = [&["sweep", "study.toml", "-o", "out"][..], more].concat();
        let output = answer(at, &words);
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains("contains files that do not belong to a sweep"), "{}", err(&output));
    }
    assert_eq!(fs::read_to_string(at.join("out/thesis.tex")).unwrap(), "years of work");
}

#[test]
fn flags_that_make_no_sense_are_refused_in_words() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    for (more, said) in [
        (&["--shard", "0/3"][..], "shards are counted from 1"),
        (&["--shard", "4/3"], "the last is 3/3"),
        (&["--keep", "some"], "unknown choice of runs"),
        (&["--keep", "24"], "there is no sample 24"),
        (&["--keep", "worst 2 by hick"], "there is no measure `hick`"),
        (&["--shard", "1/2", "--csv"], "a part of the study is not written as CSV"),
        (&["--range", "5..5"], "has no sample"),
        (&["--range", "5..25"], "ends beyond the study, which has 24 samples"),
        (&["--range", "half"], "is not a range"),
        (&["--shard", "1/2", "--restart"], "would remove the results of the others"),
        (&["--threads", "0"], "invalid value '0'"),
        (&["--set", "path.sped=3"], "sped"),
    ] {
        let output = answer(at, &[&["sweep", "study.toml", "-o", "out"][..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        assert!(err(&output).contains(said), "{more:?}: {}", err(&output));
    }
    assert!(!at.join("out").exists());
    let output = answer(at, &["sweep", "merge", "."]);
    assert!(err(&output).contains("does not contain a sweep"), "{}", err(&output));
    let output = answer(at, &["sweep", "nowhere.toml", "-o", "out"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("nowhere.toml cannot be read"), "{}", err(&output));
    fs::write(
        at.join("astray.toml"),
        "seed = 1\nbase = \"none.toml\"\n[design]\nkind = \"latin_hypercube\"\nsamples = 1\n",
    )
    .expect("written");
    let output = answer(at, &["sweep", "astray.toml", "-o", "out"]);
    assert_eq!(output.status.code(), Some(2));
    let said = err(&output);
    assert!(said.contains("none.toml cannot be read") && said.contains("astray.toml:2:"), "{said}");
}

/// A study of the interval of the outputs, which a run of 30 ms refuses above 30 ms.
fn of_intervals(design: &str, from: &str) -> String {
    let study = STUDY.replace("{ kind = \"latin_hypercube\", samples = 24 }", design);
    let head = study.split("[[parameters]]").next().expect("a head");
    format!("{head}[[parameters]]\npath = \"output.interval\"\nrange = {{ from = \"{from}\", to = \"2 s\" }}\n")
}

#[test]
fn a_study_of_which_every_sample_is_refused_has_failed_and_says_why() {
    let folder = folder_with(&of_intervals("{ kind = \"latin_hypercube\", samples = 3 }", "1 s"));
    for more in [&[][..], &["--quiet"]] {
        let output = answer(folder.path(), &[&["sweep", "study.toml", "-o", "out", "--restart"][..], more].concat());
        let said = err(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("every sample tried is invalid"), "{said}");
        assert!(said.contains("no longer than the run"), "{said}");
        assert!(!folder.path().join("out").exists());
    }
    let output = answer(folder.path(), &["sweep", "study.toml", "-o", "dry", "--dry-run"]);
    let said = err(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("of 2 corners of the study, 2 are invalid"), "{said}");
}

#[test]
fn a_dry_run_tries_the_corners_of_the_study_and_tells_all_that_are_refused() {
    let folder = folder_with(&of_intervals("{ kind = \"one_at_a_time\" }", "1 ms"));
    let said = done(folder.path(), &["sweep", "study.toml", "-o", "dry", "--dry-run"]);
    assert!(said.contains("1 of 2 are INVALID"), "{said}");
    let corner = said.lines().find(|line| line.contains("output.interval = ")).expect("a line for the corner");
    assert!(corner.contains("no longer than the run"), "{corner}");
    assert!(!folder.path().join("dry").exists());
    // without fault, all stand: each of two parameters alone, and both together
    let folder = folder_with(STUDY);
    let said = done(folder.path(), &["sweep", "study.toml", "-o", "dry", "--dry-run"]);
    assert!(said.contains("8 combinations of smallest and largest values tried, all valid"), "{said}");
}

#[test]
fn a_dry_run_of_an_ensemble_shows_samples_and_members_as_numbers() {
    let folder = folder_with(&format!("{STUDY}\n[ensemble]\nmembers = 3\n"));
    let said = done(folder.path(), &["sweep", "study.toml", "-o", "dry", "--dry-run"]);
    assert!(!said.contains("NaN") && !said.contains("inf"), "{said}");
    let second = said.lines().rev().nth(3).expect("rows");
    assert!(second.split_whitespace().rev().take(2).eq(["1", "0"]), "{second}");
}

/// A half sine has no plateau: no sample can be run, and nothing is written that reads as results.
#[test]
fn a_study_without_any_sample_that_can_be_run_is_refused_at_once() {
    let study = "title = \"x\"\nbase = \"case.toml\"\n[design]\nkind = \"KIND\"\n[[parameters]]\nname = \"plateau\"\n\
                 path = \"path.plateau\"\nlist = [\"10 ms\", \"20 ms\"]\n";
    for kind in ["one_at_a_time", "full_factorial"] {
        let folder = folder_with(&study.replace("KIND", kind));
        let output = answer(folder.path(), &["sweep", "study.toml", "-o", "out"]);
        assert_eq!(output.status.code(), Some(2));
        let said = err(&output);
        assert!(said.contains("every sample tried is invalid") && said.contains("plateau"), "{said}");
        assert!(!folder.path().join("out").exists());
    }
}

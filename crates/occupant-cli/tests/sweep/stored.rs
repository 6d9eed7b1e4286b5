//! Sweeps into an object store.

use super::*;

#[test]
#[cfg(not(feature = "object-store"))]
fn a_build_without_object_stores_says_which_feature_has_them() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    for words in [
        &["sweep", "study.toml", "-o", "s3://bucket/prefix"][..],
        &["sweep", "status", "s3://bucket/prefix"],
        &["sweep", "merge", "file:///tmp/none", "-o", "out"],
        &["study", "report", "az://container/prefix", "-o", "page.html"],
    ] {
        let output = answer(at, words);
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(err(&output).contains("feature `object-store`"), "{}", err(&output));
    }
    let said = err(&answer(at, &["sweep", "study.toml", "-o", "ftp://host/x"]));
    assert!(said.contains("is no address of an object store") && said.contains("s3://BUCKET/PREFIX"), "{said}");
    assert_eq!(fs::read_dir(at).unwrap().count(), 2, "nothing was written");
}

/// Each range in a scratch folder of its own, as on machines that share nothing; the table is that of one folder.
#[test]
#[cfg(feature = "object-store")]
fn ranges_of_machines_that_share_nothing_meet_in_a_store() {
    let folder = folder_with(&STUDY.replace("[set]", "keep = [0, 13]\n[set]"));
    let at = folder.path();
    fs::create_dir(at.join("store")).unwrap();
    let store = format!("file://{}/store/prefix", at.display());
    let part = |shard: &str, scratch: &str| {
        let words = ["sweep", "study.toml", "-o", &store, "--scratch", scratch, "--shard", shard];
        spoken(at, &words)
    };
    assert!(part("1/3", "a").contains("occupant sweep merge"));
    let there = files(&at.join("store/prefix/parts"), ".parquet");
    assert_eq!(there.len(), 1);
    let bytes = fs::read(&there[0]).unwrap();
    assert_eq!(files(&at.join("store/prefix/runs"), ".mcap").len(), 1);
    assert!(files(&at.join("a/parts"), ".parquet").is_empty() && files(&at.join("a/runs"), ".mcap").is_empty());
    // again, from another machine: nothing is computed
    assert!(part("1/3", "b").contains("samples 0 to 7: finished, in file://"));
    assert_eq!(fs::read(&there[0]).unwrap(), bytes);
    let status = done(at, &["sweep", "status", &store]);
    assert!(status.contains("8 of 24") && status.contains("8–23"), "{status}");
    let merge = ["sweep", "merge", &store, "-o", "out", "--csv"];
    assert!(err(&answer(at, &merge)).contains("16 of 24 samples are missing"));
    part("2/3", "b");
    part("3/3", "c");
    done(at, &merge);
    done(at, &["sweep", "study.toml", "-o", "one", "--csv"]);
    assert_eq!(rows(at, "out"), rows(at, "one"));
    assert!(done(at, &["study", "report", &store, "-o", "page.html"]).contains("speed"));
    assert!(at.join("page.html").is_file());
}

#[test]
#[cfg(feature = "object-store")]
fn a_store_of_another_study_is_refused_and_a_damaged_part_is_noticed() {
    let folder = folder_with(STUDY);
    let at = folder.path();
    fs::create_dir(at.join("store")).unwrap();
    let store = format!("file://{}/store", at.display());
    let words = ["sweep", "study.toml", "-o", &store, "--scratch", "a", "--range", "0..3"];
    done(at, &words);
    fs::write(at.join("other.toml"), STUDY.replace("seed = 3", "seed = 4")).unwrap();
    let other = ["sweep", "other.toml", "-o", &store, "--scratch", "b", "--range", "0..3"];
    let said = err(&answer(at, &other));
    assert!(said.contains("contains another sweep") && said.contains("seed"), "{said}");
    for words in [&["sweep", "study.toml", "-o", &store, "--restart"][..], &["sweep", "merge", &store]] {
        assert_eq!(answer(at, words).status.code(), Some(2), "{words:?}");
    }
    let none = format!("file://{}/nothing", at.display());
    let said = err(&answer(at, &["sweep", "status", &none]));
    assert!(said.contains("does not contain a sweep"), "{said}");
    let part = files(&at.join("store/parts"), ".parquet").remove(0);
    crate::common::damage(&part, false);
    let output = answer(at, &["study", "report", &store, "-o", "page.html"]);
    assert!(output.status.code() == Some(2) && err(&output).contains("was changed"), "{}", err(&output));
}

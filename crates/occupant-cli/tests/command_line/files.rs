use std::process::{Command, Stdio};

use super::{answer, code, err, folder_with_case};

#[test]
fn a_file_that_exists_is_not_written_over() {
    let folder = folder_with_case();
    let file = folder.path().join("case.mcap");
    std::fs::write(&file, "mine").unwrap();
    let output = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("--force"), "{}", err(&output));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "--force"])), 0);
    assert!(std::fs::metadata(&file).unwrap().len() > 10_000);
}

#[test]
fn an_earlier_run_of_the_same_scenario_is_replaced_and_nothing_else() {
    let folder = folder_with_case();
    let at = |name: &str| folder.path().join(name);
    let run = |words: &[&str]| {
        let output = answer(folder.path(), &[&["run", "case.toml", "--until", "10 ms"], words].concat());
        (code(&output), err(&output).contains("replacing case.mcap, an earlier run of this scenario"))
    };
    assert_eq!(run(&[]), (0, false));
    let text = std::fs::read_to_string(at("case.toml")).unwrap();
    std::fs::write(at("case.toml"), text.replace("speed = \"50 km/h\"", "speed = \"40 km/h\"")).unwrap();
    let before = std::fs::read(at("case.mcap")).unwrap();
    assert_eq!(run(&[]), (0, true));
    let after = std::fs::read(at("case.mcap")).unwrap();
    assert!(before != after);
    // another variant, a name that was asked for, a scenario with another title, one of another folder
    assert_eq!(run(&["--set", "path.speed='60 km/h'"]), (2, false));
    assert_eq!(run(&["-o", "case.mcap"]), (2, false));
    assert_eq!(run(&["--set", "title='another'"]), (2, false));
    std::fs::create_dir(at("there")).unwrap();
    std::fs::copy(at("case.toml"), at("there/case.toml")).unwrap();
    assert_eq!(code(&answer(folder.path(), &["run", "there/case.toml", "--until", "10 ms"])), 2);
    // a file that may not be written
    let protect = |is_so: bool| {
        let mut rights = std::fs::metadata(at("case.mcap")).unwrap().permissions();
        rights.set_readonly(is_so);
        std::fs::set_permissions(at("case.mcap"), rights).unwrap();
    };
    protect(true);
    assert_eq!(run(&[]), (2, false));
    protect(false);
    // what a run that broke off has left can be resumed, and is not taken
    std::fs::write(at("case.partial.mcap"), "half").unwrap();
    assert_eq!(run(&[]), (2, false));
    std::fs::remove_file(at("case.partial.mcap")).unwrap();
    // nor what is damaged
    assert!(after == std::fs::read(at("case.mcap")).unwrap());
    assert_eq!(run(&["--quiet"]), (0, true), "it is said even so");
    std::fs::write(at("case.mcap"), &after[..after.len() / 2]).unwrap();
    assert_eq!(run(&[]), (2, false));
}

#[test]
fn several_scenarios_are_refused_before_any_runs() {
    let folder = folder_with_case();
    std::fs::create_dir(folder.path().join("there")).unwrap();
    std::fs::copy(folder.path().join("case.toml"), folder.path().join("there/case.toml")).unwrap();
    for (other, said) in [("there/case.toml", "would write the same file"), ("none.toml", "none.toml")] {
        let output = answer(folder.path(), &["run", "case.toml", other, "--force"]);
        assert_eq!(code(&output), 2);
        assert!(err(&output).contains(said), "{}", err(&output));
        assert!(!folder.path().join("case.mcap").exists());
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_of_the_shell_is_read_and_bounded() {
    let folder = folder_with_case();
    let program = assert_cmd::cargo::cargo_bin!("occupant");
    let said = |words: &str| {
        let script = words.replace("occupant", &format!("'{}'", program.display()));
        Command::new("sh").current_dir(folder.path()).args(["-c", &script]).output().unwrap()
    };
    let whole = said("cat case.toml | occupant check /dev/stdin");
    assert_eq!(code(&whole), 0, "{}", err(&whole));
    assert_eq!(whole.stdout, said("occupant check case.toml").stdout);
    let endless = said("yes '# more' | occupant check /dev/fd/0");
    assert_eq!(code(&endless), 2);
    assert!(err(&endless).contains("longer than 32 MB"), "{}", err(&endless));
    let device = said("occupant check /dev/fd/0 < /dev/zero");
    assert!(err(&device).contains("not an ordinary file"), "{}", err(&device));
}

#[test]
fn what_an_interrupted_run_left_is_not_written_over() {
    let folder = folder_with_case();
    let partial = folder.path().join("case.partial.mcap");
    std::fs::write(&partial, "half").unwrap();
    let output = answer(folder.path(), &["run", "case.toml"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("case.partial.mcap"), "{}", err(&output));
    assert_eq!(std::fs::read_to_string(&partial).unwrap(), "half");
    assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "-f"])), 0);
    assert!(!partial.exists());
}

#[test]
fn the_same_scenario_gives_the_same_bytes() {
    let folder = folder_with_case();
    for name in ["a.mcap", "b.mcap"] {
        assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "-q", "-o", name])), 0);
    }
    let bytes = |name| std::fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.mcap") == bytes("b.mcap"));
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "case.toml", "-o", "no/such/run.mcap"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).replace('\\', "/").contains("no/such/run.partial.mcap"), "{}", err(&output));
}

/// Two processes write one name: the file is a whole run of one that said so, and no provisional one is left.
#[test]
fn two_processes_that_write_one_name_leave_one_whole_run() {
    let folder = folder_with_case();
    let run = |speed: &str, words: &[&str]| {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
        command.args(["run", "case.toml", "-q", "-o", "x.mcap", "--set", "time.end=0.02", "--set", speed]).args(words);
        command.current_dir(folder.path()).stderr(Stdio::null()).spawn().unwrap()
    };
    let speeds = ["path.speed='20 mph'", "path.speed='30 mph'"];
    let whole = speeds.map(|speed| {
        assert!(run(speed, &["-f"]).wait().unwrap().success());
        std::fs::read(folder.path().join("x.mcap")).unwrap()
    });
    for round in 0..20 {
        let force: &[&str] = if round % 2 == 0 { &["-f"] } else { &[] };
        let _ = std::fs::remove_file(folder.path().join("x.mcap"));
        let done = speeds.map(|speed| run(speed, force)).map(|mut child| child.wait().unwrap().code());
        let found = std::fs::read(folder.path().join("x.mcap")).unwrap();
        let theirs = whole.iter().position(|whole| *whole == found).expect("one whole run");
        assert_eq!(done[theirs], Some(0), "{done:?}");
        assert!(round % 2 == 0 || done[1 - theirs] != Some(0), "without --force one of them wins: {done:?}");
        let partial = folder.path().join("x.partial.mcap");
        let _of_the_one_that_came_too_late = round % 2 == 1 && std::fs::remove_file(&partial).is_ok();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    }
}

#[cfg(unix)]
#[test]
fn links_keep_pointing_where_they_point_and_devices_are_refused() {
    use std::os::unix::fs::symlink;
    let folder = folder_with_case();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("elsewhere")).unwrap();
    symlink("elsewhere/run.mcap", at("link.mcap")).unwrap();
    for words in [&["-q"][..], &["-q", "-f"]] {
        assert_eq!(code(&answer(folder.path(), &[&["run", "case.toml", "-o", "link.mcap"], words].concat())), 0);
        assert!(std::fs::symlink_metadata(at("link.mcap")).unwrap().is_symlink());
        assert!(std::fs::metadata(at("elsewhere/run.mcap")).unwrap().len() > 10_000);
        assert_eq!(std::fs::read_dir(at("elsewhere")).unwrap().count(), 1);
    }
    symlink("/dev/null", at("device.toml")).unwrap();
    symlink("/dev/null", at("device.mcap")).unwrap();
    for words in
        [&["new", "device.toml", "-f"][..], &["new", "device.toml"], &["run", "case.toml", "-f", "-o", "device.mcap"]]
    {
        let output = answer(folder.path(), words);
        assert_eq!(code(&output), 2);
        assert!(err(&output).contains("is not an ordinary file"), "{}", err(&output));
    }
}

#[test]
fn a_run_is_written_only_under_a_name_and_with_a_scenario_that_can_be_read_again() {
    let folder = folder_with_case();
    let output = answer(folder.path(), &["run", "case.toml", "-o", "x.txt"]);
    assert!(code(&output) == 2 && err(&output).contains("use the extension .mcap"), "{}", err(&output));
    assert!(!folder.path().join("x.txt").exists());

    // what it leaves out would make it too long
    let case = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    let notes = "x".repeat(1_999_900 - case.len());
    std::fs::write(folder.path().join("long.toml"), format!("notes = \"{notes}\"\n{case}")).unwrap();
    let output = answer(folder.path(), &["run", "long.toml", "-q"]);
    assert!(code(&output) == 2 && err(&output).contains("too long for a result file"), "{}", err(&output));
    assert!(!folder.path().join("long.partial.mcap").exists());
    assert_eq!(code(&answer(folder.path(), &["run", "long.toml", "-q", "--no-mcap"])), 0);

    // whatever a scenario's file is called
    std::fs::write(folder.path().join("long.txt"), vec![b' '; 2_000_001]).unwrap();
    let output = answer(folder.path(), &["check", "long.txt"]);
    assert!(err(&output).contains("the limit for such a file is 2 MB"), "{}", err(&output));
}

/// A limit on the size of files stands for a disk that is full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_leaves_nothing_half_written_under_a_final_name() {
    let folder = folder_with_case();
    assert_eq!(code(&answer(folder.path(), &["run", "case.toml", "-q", "-o", "run.mcap"])), 0);
    let before = std::fs::read_dir(folder.path()).unwrap().count();
    let occupant = assert_cmd::cargo::cargo_bin!("occupant").display();
    for words in [
        "new a.toml",
        "print run.mcap -o a.txt",
        "report run.mcap -o a.html",
        "export run.mcap -o a.csv",
        "run case.toml",
    ] {
        let script = format!("trap '' XFSZ; ulimit -f 2; exec {occupant} {words}");
        let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
        assert_eq!(code(&output), 1, "{words}: {}", err(&output));
        assert!(err(&output).contains("File too large"), "{words}: {}", err(&output));
        assert!(err(&output).contains("a.") || err(&output).contains("case.partial.mcap"), "{}", err(&output));
    }
    // what the run has left can be resumed
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), before + 1);
    assert!(folder.path().join("case.partial.mcap").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_result_that_cannot_be_written_to_standard_output_is_a_failure() {
    let folder = folder_with_case();
    for words in [&["--help"][..], &["--version"], &["check", "case.toml"], &["schema"]] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("occupant"));
        let output = command.args(words).stdout(full).current_dir(folder.path()).output().unwrap();
        assert_eq!(code(&output), 1, "{words:?}");
        assert!(err(&output).contains("standard output"), "{}", err(&output));
        let script = format!("exec {} {} >&-", assert_cmd::cargo::cargo_bin!("occupant").display(), words.join(" "));
        let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
        assert_eq!(code(&output), 1, "{script}");
        assert!(err(&output).contains("standard output: it is closed"), "{}", err(&output));
    }
    // nothing is to be written
    let script = format!("exec {} check -q case.toml >&-", assert_cmd::cargo::cargo_bin!("occupant").display());
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    assert_eq!(code(&output), 0, "{}", err(&output));
}

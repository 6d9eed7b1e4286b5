//! What is particular to Windows.
#![cfg(windows)]

use std::fs::{self, OpenOptions};
use std::os::windows::fs::OpenOptionsExt;

use super::{answer, code, err, folder_with_case};

#[test]
fn long_paths_with_a_drive_and_either_slash() {
    let folder = folder_with_case();
    let deep = (0..12).fold(folder.path().canonicalize().unwrap(), |path, _| path.join("a folder with a long name"));
    fs::create_dir_all(&deep).unwrap();
    let plain = deep.display().to_string().replace(r"\\?\", "");
    assert!(plain.len() > 260 && plain.as_bytes()[1] == b':', "{plain}");
    for (i, name) in
        [format!(r"{plain}\run0.mcap"), format!("{}/run1.mcap", plain.replace('\\', "/"))].iter().enumerate()
    {
        let output = answer(folder.path(), &["run", "case.toml", "--until", "10 ms", "-o", name]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        assert!(deep.join(format!("run{i}.mcap")).exists());
    }
}

#[test]
fn line_ends_of_windows_change_no_bit() {
    let folder = folder_with_case();
    let at = |name: &str| folder.path().join(name);
    let text = fs::read_to_string(at("case.toml")).unwrap().replace("\r\n", "\n");
    let json = |text: String| {
        fs::write(at("case.toml"), text).unwrap();
        let output = answer(folder.path(), &["run", "case.toml", "--until", "20 ms", "--no-mcap", "--json"]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        let mut summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(summary["solver"]["wall_time_s"].take().is_number());
        summary
    };
    let [plain, windows] = [text.clone(), text.replace('\n', "\r\n")].map(json);
    assert!(plain["measures"].is_array(), "{plain}");
    assert_eq!(plain, windows);
}

/// Another program that reads a result and shares it with nobody.
#[test]
fn a_result_that_cannot_be_replaced_is_kept_beside_it() {
    let folder = folder_with_case();
    let at = |name: &str| folder.path().join(name);
    let run = || answer(folder.path(), &["run", "case.toml", "--until", "10 ms", "--force"]);
    assert_eq!(code(&run()), 0);
    let held = OpenOptions::new().read(true).share_mode(0).open(at("case.mcap")).unwrap();
    let output = run();
    assert_eq!(code(&output), 1, "{}", err(&output));
    assert!(err(&output).contains("case.mcap"), "{}", err(&output));
    assert!(at("case.partial.mcap").exists());
    drop(held);
    assert_eq!(code(&run()), 0);
}

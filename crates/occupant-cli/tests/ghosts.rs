//! `occupant view --3d` with other runs and with pictures of a test, as a user calls it.

use std::fs;
use std::path::Path;

use occupant_pictures::Format;

use crate::common::{answer, err, occupant, spoken};

const SHORT: &str = include_str!("recording/short.toml");
/// Small pictures of one moment; `v.gif` is read back.
const ONE: [&str; 9] = ["view", "run.mcap", "--3d", "-f", "-o", "v.gif", "--size", "320x180", "--times"];

/// A folder with a run, another at a third of the speed, and one that begins later and ends earlier.
fn folder_with_runs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("case.toml"), SHORT).expect("written");
    let slow = ["--set", "path.speed=3", "--set", "path.delta_v=3"];
    let brief = ["--set", "time.start=0", "--set", "time.end=0.01"];
    for (name, more) in [("run.mcap", &[][..]), ("slow.mcap", &slow), ("brief.mcap", &brief)] {
        spoken(folder.path(), &[&["run", "case.toml", "-q", "-o", name], more].concat());
    }
    folder
}

/// Frames of a film as red, green, blue, row by row, with its width.
fn film(path: &Path) -> (Vec<Vec<[u8; 3]>>, usize) {
    let bytes = fs::read(path).expect("a film");
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut film = options.read_info(&bytes[..]).expect("a GIF");
    let [width, height] = [film.width(), film.height()].map(usize::from);
    let mut shown = vec![[0; 3]; width * height];
    let mut frames = Vec::new();
    while let Some(frame) = film.read_next_frame().expect("a frame") {
        for (i, pixel) in frame.buffer.chunks(4).enumerate().filter(|(_, pixel)| pixel[3] > 0) {
            let [x, y] = [i % usize::from(frame.width), i / usize::from(frame.width)];
            shown[(usize::from(frame.top) + y) * width + usize::from(frame.left) + x] = [pixel[0], pixel[1], pixel[2]];
        }
        frames.push(shown.clone());
    }
    (frames, width)
}

/// The one frame at a time, between the words above and below it.
fn picture(folder: &Path, time: &str, more: &[&str]) -> Vec<[u8; 3]> {
    spoken(folder, &[&ONE[..], &[time], more].concat());
    let (frames, width) = film(&folder.join("v.gif"));
    assert_eq!((frames.len(), width), (1, 320));
    frames[0][30 * width..130 * width].to_vec()
}

fn pink(picture: &[[u8; 3]]) -> usize {
    picture.iter().filter(|[r, g, b]| *r > g.saturating_add(40) && *b > g.saturating_add(15)).count()
}

/// A slower occupant is seen in the car of the run and, elsewhere, on the ground; the run itself is not.
#[test]
fn a_ghost_is_seen_where_it_differs() {
    let folder = folder_with_runs();
    let at = |more: &[&str]| pink(&picture(folder.path(), "25 ms", more));
    for camera in ["vehicle", "ground", "chase"] {
        let camera = ["--camera", camera];
        let ghost = |name| at(&[&camera[..], &["--ghost", name]].concat());
        // measured: 0, 0 and hundreds
        assert_eq!([at(&camera), ghost("run.mcap")], [0, 0], "{camera:?}");
        assert!(ghost("slow.mcap") > 50, "{camera:?}: {}", ghost("slow.mcap"));
    }
    // three at once, and a film that stops
    let all = ["--ghost", "run.mcap", "--ghost", "run.mcap", "--ghost", "slow.mcap"];
    let green = |picture: &[[u8; 3]]| picture.iter().filter(|[r, g, b]| *g > r.saturating_add(20) && g >= b).count();
    let [alone, three] = [&[][..], &all].map(|more| green(&picture(folder.path(), "25 ms", more)));
    assert!(alone == 0 && three > 50, "{alone} {three}");
    let moving = ["view", "run.mcap", "--3d", "-f", "-o", "v.gif", "--size", "160x90", "--slow-motion", "100"];
    spoken(folder.path(), &[&moving[..], &["--freeze", "0", "--ghost", "slow.mcap"]].concat());
    let (frames, _) = film(&folder.path().join("v.gif"));
    // 40 ms a frame, 50 at rest
    assert_eq!(frames.len(), 99 + 50);
}

/// Before its first and after its last output a ghost stands still: it looks the same then, and the words say so.
#[test]
fn a_run_that_ends_earlier_stays() {
    let folder = folder_with_runs();
    for time in ["-10 ms", "5 ms", "29 ms"] {
        let said = spoken(folder.path(), &[&ONE[..], &[time, "--ghost", "brief.mcap"]].concat());
        assert!(said.contains("brief.mcap covers 0 to 10 ms") && said.contains("wrote"), "{said}");
    }
    // a half of its own, in a film of one palette and one place of the camera: it moves until 10 ms
    let more = ["5,10,14,29 ms", "--beside", "brief.mcap", "--camera", "ground"];
    spoken(folder.path(), &[&ONE[..], &more].concat());
    let (frames, width) = film(&folder.path().join("v.gif"));
    let half = |frame: usize, from: usize| -> Vec<[u8; 3]> {
        frames[frame].chunks(width).skip(30).take(95).flat_map(|row| row[from..from + 158].to_vec()).collect()
    };
    assert!(half(0, 162) != half(1, 162) && half(1, 162) == half(2, 162) && half(2, 162) == half(3, 162));
    assert!(half(1, 0) != half(2, 0) && half(2, 0) != half(3, 0));
    // its clock is that of the run: the words above are those of the other half, but for the title
    let clock = |frame: usize, from: usize| -> Vec<[u8; 3]> {
        frames[frame].chunks(width).take(12).flat_map(|row| row[from + 110..from + 158].to_vec()).collect()
    };
    // the words stand on a translucent ground, and a GIF has 256 colours
    let is_like =
        |a: &[[u8; 3]], b: &[[u8; 3]]| a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| a.abs_diff(*b) < 8);
    assert!((0..4).all(|frame| is_like(&clock(frame, 2), &clock(frame, 162))) && !is_like(&clock(1, 2), &clock(3, 2)));
}

/// A run beside itself is twice the same half; another one differs.
#[test]
fn halves_have_one_scale_and_one_clock() {
    let folder = folder_with_runs();
    let differ = |more: &[&str]| {
        let rows = picture(folder.path(), "25 ms", more);
        let of = |row: &[[u8; 3]]| row[2..160].iter().zip(&row[162..]).filter(|(a, b)| a != b).count();
        rows.chunks(320).map(of).sum::<usize>()
    };
    for camera in ["vehicle", "ground", "chase", "driver"] {
        assert_eq!(differ(&["--camera", camera, "--beside", "run.mcap"]), 0, "{camera}");
        assert!(differ(&["--camera", camera, "--beside", "slow.mcap"]) > 300, "{camera}");
    }
    // ghosts stand in the half of the run
    let rows = picture(folder.path(), "25 ms", &["--beside", "run.mcap", "--ghost", "slow.mcap"]);
    let [left, right] = [0, 160].map(|from| rows.chunks(320).map(|row| pink(&row[from..from + 160])).sum::<usize>());
    // measured: 642 and 36, of the palette of a GIF
    assert!(left > 300 && right < left / 10, "{left} {right}");
    // a sheet, an odd width
    let words = ["view", "run.mcap", "--3d", "-f", "-o", "v.png", "--size", "161x91", "--times", "0,1,2,3 ms"];
    spoken(folder.path(), &[&words[..], &["--beside", "slow.mcap"]].concat());
    let png = fs::read(folder.path().join("v.png")).expect("a sheet");
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().expect("four"));
    assert_eq!([side(16), side(20)], [3 * 161, 2 * 91]);
}

/// Writes a picture of one colour.
fn paint(path: &Path, colour: &str) {
    let svg = format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="64" height="64"><rect width="64" height="64" fill="{colour}"/></svg>"#
    );
    fs::write(path, Format::Png.encode(&svg, 1.0).expect("a picture")).expect("written");
}

/// The last picture at or before the time is shown, whole.
#[test]
fn pictures_of_a_test_are_chosen_by_their_times() {
    let folder = folder_with_runs();
    let test = folder.path().join("test");
    fs::create_dir(&test).expect("a folder");
    for (name, colour) in [("2.png", "red"), ("10.png", "blue"), ("4.5.PNG", "lime")] {
        paint(&test.join(name), colour);
    }
    fs::write(test.join("notes.txt"), "of no account").expect("written");
    fs::write(test.join("._2.png"), "of no account").expect("written");
    let dark = [40, 44, 50];
    let places =
        [("1 ms", dark), ("2 ms", [255, 0, 0]), ("4 ms", [255, 0, 0]), ("5 ms", [0, 255, 0]), ("29 ms", [0, 0, 255])];
    for (time, expected) in places {
        let rows = picture(folder.path(), time, &["--beside", "test"]);
        let at = |x: usize| rows[50 * 320 + x];
        let close = |own: [u8; 3], other: [u8; 3]| own.iter().zip(other).all(|(a, b)| a.abs_diff(b) < 24);
        assert!(close(at(240), expected), "{time}: {:?}", at(240));
        // a square in a wide place
        assert!(close(at(168), dark) && close(at(312), dark), "{time}: {:?} {:?}", at(168), at(312));
    }
    // one picture is shown all the time
    fs::copy(test.join("10.png"), folder.path().join("still.png")).expect("a copy");
    let [r, _, b] = picture(folder.path(), "1 ms", &["--beside", "still.png"])[50 * 320 + 240];
    assert!(b > 200 && r < 50);
}

#[test]
fn the_bits_of_pictures_of_several_runs_do_not_depend_on_threads() {
    let folder = folder_with_runs();
    let with = |threads: &str| {
        let words = ["view", "run.mcap", "--3d", "-f", "-o", "v.png", "--size", "320x180", "--times", "5,25 ms"];
        let more = ["--ghost", "slow.mcap", "--ghost", "brief.mcap", "--beside", "slow.mcap"];
        let mut command = occupant(folder.path());
        let output = command.args(words).args(more).env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        fs::read(folder.path().join("v.png")).expect("a picture")
    };
    let one = with("1");
    assert!(["2", "5"].iter().all(|threads| with(threads) == one));
}

#[test]
fn a_ghost_that_was_cut_off_is_shown_as_far_as_it_goes() {
    let folder = folder_with_runs();
    let name = folder.path().join("slow.mcap");
    let mut bytes = fs::read(&name).expect("results");
    let end = bytes.windows(15).position(|word| word == b"occupant.result");
    bytes.truncate(end.expect("a record of the result") - 20);
    fs::write(&name, bytes).expect("written");
    let words = [&ONE[..], &["25 ms", "--ghost", "slow.mcap"]].concat();
    let said = spoken(folder.path(), &words);
    assert!(said.contains("slow.mcap") && said.contains("did not complete"), "{said}");
}

#[test]
fn wrong_words_for_other_runs_are_answered() {
    let folder = folder_with_runs();
    let at = |name: &str| folder.path().join(name);
    for name in ["test", "empty", "odd", "twice", "broken"] {
        fs::create_dir(at(name)).expect("a folder");
    }
    paint(&at("test/0.png"), "red");
    paint(&at("odd/frame_1.png"), "red");
    paint(&at("twice/1.png"), "red");
    paint(&at("twice/1.0.png"), "red");
    fs::write(at("broken/0.png"), "no picture").expect("written");
    fs::write(at("film.mp4"), "a film").expect("written");
    let refused = |more: &[&str], said: &str| {
        let usual = ["view", "run.mcap", "-f", "--size", "64x36", "--times", "0"];
        let output = answer(folder.path(), &[&usual[..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}: {}", err(&output));
        assert!(err(&output).contains(said), "{more:?}: {}", err(&output));
    };
    let plain = |more: &[&str], said: &str| {
        let output = answer(folder.path(), &[&["view", "run.mcap", "-o", "v.png"], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        assert!(err(&output).contains(said), "{more:?}: {}", err(&output));
    };
    plain(&["--ghost", "slow.mcap"], "add --3d");
    plain(&["--beside", "slow.mcap"], "add --3d");
    let four = ["--ghost", "slow.mcap", "--ghost", "slow.mcap", "--ghost", "slow.mcap", "--ghost", "slow.mcap"];
    refused(&[&["--3d", "-o", "v.png"], &four[..]].concat(), "at most 3 can be told apart");
    refused(&["--3d", "-o", "v.png", "--ghost", "case.toml"], "run it with `occupant run case.toml`");
    refused(&["--3d", "-o", "v.png", "--beside", "case.toml"], "run it with `occupant run case.toml`");
    refused(&["--3d", "-o", "v.png", "--ghost", "none.mcap"], "there is no such file");
    refused(&["--3d", "-o", "v.png", "--beside", "none"], "none");
    refused(&["--3d", "-o", "v.png", "--beside", "film.mp4"], "named by their times in ms");
    refused(&["--3d", "-o", "v.png", "--beside", "empty"], "holds no PNG file");
    refused(&["--3d", "-o", "v.png", "--beside", "odd"], "`frame_1` is no time in ms");
    refused(&["--3d", "-o", "v.png", "--beside", "twice"], "have the same time");
    refused(&["--3d", "-o", "v.png", "--beside", "broken"], "0.png: it cannot be read as PNG");
    // nothing that is read is replaced
    for (name, more) in [("test/0.png", "test"), ("test/0.png", "test/0.png"), ("test/9.png", "test")] {
        refused(&["--3d", "-o", name, "--beside", more], "test");
    }
    for beside in ["test", "test/0.png"] {
        refused(&["--3d", "--each", "test", "--beside", beside], "write into another folder");
    }
    fs::copy(at("slow.mcap"), at("slow.gif")).expect("a copy");
    let before = fs::read(at("slow.gif")).expect("a file");
    for flag in ["--ghost", "--beside"] {
        refused(&["--3d", "-o", "slow.gif", flag, "slow.gif"], "slow.gif");
    }
    assert_eq!(fs::read(at("slow.gif")).expect("a file"), before);
    assert!(!at("v.png").exists() && !at("test/9.png").exists() && !at("test/0001.png").exists());
}

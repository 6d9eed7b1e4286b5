//! CSV files of recorded data.

use super::super::read_record;

const SOUND: &[u8] = b"t[ms],ax[g],ay[m/s^2],wz[deg/s]\n0,-1,2,3\n1,-1.5,2,3\n2,-2e0,2,3\n3,-1,2,4\n";

#[test]
fn channels_arrive_in_si_and_others_are_not_there() {
    let file = read_record(SOUND, "a.csv", None).unwrap();
    let record = &file.record;
    assert_eq!(record.time_s, [0.0, 0.001, 0.002, 0.003]);
    assert_eq!(record.acceleration_m_s2[0].as_ref().unwrap()[2], -2.0 * 9.80665);
    assert_eq!(record.acceleration_m_s2[1].as_ref().unwrap()[0], 2.0);
    assert!(record.acceleration_m_s2[2].is_none() && record.rate_rad_s[0].is_none());
    assert_eq!(record.rate_rad_s[2].as_ref().unwrap()[0], 3f64.to_radians());
}

#[test]
fn what_is_wrong_with_a_whole_file_is_said_at_its_header() {
    for (bytes, expected) in [
        (&b"t[s]\n0\n1\n"[..], "error: no acceleration and no rate\n --> a.csv:1:1"),
        (b"t[s],ax[g]\n0,1\n", "error: 1 lines of numbers\n --> a.csv:1:1"),
        (b"t[s],dvx[m/s]\n0,1\n", "error: unknown column `dvx`\n --> a.csv:1:6"),
        (b"", "error: an empty table\n --> a.csv:1:1"),
    ] {
        let found = read_record(bytes, "a.csv", None).unwrap_err().to_string();
        assert!(found.starts_with(expected), "{found}");
    }
}

#[test]
fn columns_may_be_named_beside_the_file() {
    let csv = b"zeit;speed;a_long\n0;1;-1\n1;2;-2,5\n";
    let named = |columns| read_record(csv, "a.csv", Some(columns));
    let file = named("t[ms], -, ax[g]").unwrap();
    assert_eq!(file.record.time_s, [0.0, 0.001]);
    assert_eq!(file.record.acceleration_m_s2[0].as_ref().unwrap()[1], -2.5 * 9.80665);
    let found = named("t[ms],-,axe[g]").unwrap_err().to_string();
    assert!(found.contains("unknown column `axe`\n --> columns:1:9"), "{found}");
}

use super::*;

fn read_text(text: &str) -> RawRecord {
    read(text.as_bytes()).unwrap()
}

fn refused(text: &str) -> ReadError {
    read(text.as_bytes()).unwrap_err()
}

/// Titles of the channels, their units, the times, and the first channel.
#[track_caller]
fn assert_read(text: &str, names: &[(&str, Option<&str>)], times: &[f64], first: &[f64]) {
    let raw = read_text(text);
    let group = &raw.groups[0];
    let found: Vec<(&str, Option<&str>)> =
        group.channels.iter().map(|channel| (channel.name.as_str(), channel.unit.as_deref())).collect();
    assert_eq!(found, names);
    assert_eq!(group.axis, Axis::Times(times.to_vec()));
    assert_eq!(group.channels[0].samples, first);
}

#[test]
fn dialects_read_the_same() {
    let times = &[0.0, 0.5, 1.0];
    let values = &[1.5, -2.0, 3e-2];
    for text in [
        "time [s],a [m/s^2]\n0,1.5\n0.5,-2\n1,3e-2\n",
        "time [s];a [m/s^2]\n0;1.5\n0.5;-2\n1;3e-2\n",
        "time [s];a [m/s^2]\r\n0;1,5\r\n0,5;-2\r\n1;3E-2\r\n",
        "time [s]\ta [m/s^2]\n0\t1,5\n0,5\t-2\n1\t3e-2\n",
        "\u{feff}\"time [s]\",\"a [m/s^2]\"\n\"0\",\"1.5\"\n\"0.5\",\"-2\"\n\"1\",\"3e-2\"\n",
        "Zeit;a\ns;m/s^2\n0;1,5\n0,5;-2\n1;3e-2\n",
        "time;a\n[s];[m/s^2]\n0;1.5\n0.5;-2\n1;3e-2\n",
        "A title, with a comma\n\nmade by hand\ntime [s];a [m/s^2]\n0;1,5\n0,5;-2\n1;3e-2\n",
        "# a comment\n# more\ntime [s],a [m/s^2]\n0,1.5\n# in between\n0.5,-2\n1,3e-2\n",
        "time [s],a [m/s^2],\n0,1.5,\n0.5,-2,\n1,3e-2,\n",
        "time [ms],a [m/s^2]\n0,1.5\n500,-2\n1000,3e-2\n",
    ] {
        assert_read(text, &[("a", Some("m/s^2"))], times, values);
    }
}

#[test]
fn titles_in_a_comment_are_taken() {
    assert_read("# t a\n0.0 1.0\n0.5 2.0\n", &[("a", None)], &[0.0, 0.5], &[1.0, 2.0]);
    assert_read("% time_s,x_mm\n0.0,1.0\n0.5,2.0\n", &[("x", Some("mm"))], &[0.0, 0.5], &[1.0, 2.0]);
}

#[test]
fn text_in_other_encodings() {
    let text = "time [s];x [µm]\n0;1\n1;2\n";
    let latin: Vec<u8> = text.chars().map(|character| character as u8).collect();
    let raw = read(&latin).unwrap();
    assert_eq!(raw.groups[0].channels[0].unit.as_deref(), Some("µm"));
    assert_eq!(raw.findings, [Finding::Latin1]);
    let wide: Vec<u8> = [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert_eq!(read(&wide).unwrap().groups[0].channels[0].unit.as_deref(), Some("µm"));
}

#[test]
fn time_without_title_or_unit_is_told() {
    assert_eq!(read_text("0,1\n1,5\n2,4\n").findings, [Finding::TimeAssumed]);
    assert_eq!(read_text("t,x\n0,1\n1,5\n").findings, [Finding::TimeUnitAssumed { name: "t".to_owned() }]);
    // Two channels without a time: neither rises evenly.
    assert_eq!(read_text("3,1\n1,5\n2,4\n").groups[0].axis, Axis::Unknown);
}

#[test]
fn sampling_rate_in_the_header_is_the_rate() {
    let raw = read_text("Sampling rate: 2 kHz\na [g]\n1.0\n2.0\n");
    assert_eq!(raw.groups[0].axis, Axis::Even { step_s: 0.0005, start_s: 0.0 });
    assert_eq!(raw.groups[0].channels[0].unit.as_deref(), Some("g"));
}

#[test]
fn missing_values_are_nan_and_missing_ends_are_the_end() {
    let raw = read_text("time [s],a,b\n0,1,2\n1,,3\n2,NaN,4\n3,7,\n4,8,\n");
    let channels = &raw.groups[0].channels;
    assert_eq!(
        channels[0].samples.iter().map(|value| value.is_nan()).collect::<Vec<_>>(),
        [false, true, true, false, false]
    );
    assert_eq!(channels[1].samples, [2.0, 3.0, 4.0]);
}

#[test]
fn text_among_numbers_is_refused_with_its_place() {
    assert_eq!(
        refused("time [s],a\n0,1\n1,2\n2,overload\n3,4\n"),
        ReadError::NotANumber { line: 4, column: 2, text: "overload".to_owned() }
    );
}

#[test]
fn rows_of_other_lengths_are_refused_with_their_line() {
    assert_eq!(refused("t,a\n0,1\n1,2\n2\n3,4\n"), ReadError::RaggedRow { line: 4, found: 1, expected: 2 });
    assert_eq!(refused("t,a\n0,1\n1,2\n2,3,9\n"), ReadError::RaggedRow { line: 4, found: 3, expected: 2 });
}

#[test]
fn files_without_numbers_are_refused() {
    assert_eq!(refused("only words\nand more\n"), ReadError::NoNumbers);
    assert_eq!(read(b"\x00\x01\x02\x03").unwrap_err(), ReadError::UnknownFormat);
}

#[test]
fn equal_names_get_numbers() {
    let raw = read_text("time [s],a,a,a\n0,1,2,3\n1,1,2,3\n");
    let names: Vec<&str> = raw.groups[0].channels.iter().map(|channel| channel.name.as_str()).collect();
    assert_eq!(names, ["a", "a (2)", "a (3)"]);
}

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
    assert_eq!(group.axis, TimeAxis::Times(times.to_vec()));
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
fn lines_that_end_in_carriage_returns_alone_are_read() {
    assert_read("t [s];a\r0;1,5\r1;2,5\r", &[("a", None)], &[0.0, 1.0], &[1.5, 2.5]);
}

#[test]
fn commas_without_titles_are_decimal_signs_or_reported() {
    // No whole number is written as 00.
    let decimal = read_text("0,00\n1,37\n0,02\n");
    assert_eq!((decimal.groups[0].channels.len(), &decimal.findings[..]), (1, &[][..]));
    assert_eq!(decimal.groups[0].channels[0].samples, [0.0, 1.37, 0.02]);
    let either = read_text("3,10\n1,37\n2,42\n");
    assert_eq!(
        (either.groups[0].channels.len(), &either.findings[..]),
        (2, &[RecordFinding::CommasSeparate][..])
    );
}

#[test]
fn column_that_starts_with_minus_one_or_a_title_with_matlab_is_read() {
    for text in ["-1\n0.5\n1.5\n", "-1\n3\n4\n", "MATLAB export\n-1\n3\n4\n"] {
        let raw = crate::read::parse(text.as_bytes()).unwrap();
        assert_eq!(raw.groups[0].channels[0].samples[0], -1.0, "{text}");
    }
}

#[test]
fn time_can_be_named() {
    let text = "clock [ms],x [mm],a\n0,1,5\n1000,2,7\n2000,4,9\n";
    let named = |name: &str| read_text(text).with_time(name).unwrap();
    assert_eq!(named("clock"), read_text(text), "already the time");
    let by_x = named("x");
    assert_eq!(by_x.groups[0].axis, TimeAxis::Times(vec![1.0, 2.0, 4.0]));
    let clock = &by_x.groups[0].channels[0];
    // As it stands in the file, with its unit.
    assert_eq!((clock.name.as_str(), clock.unit.as_deref()), ("clock", Some("ms")));
    assert_eq!(clock.samples, [0.0, 1000.0, 2000.0]);
    assert_eq!(by_x.findings, [RecordFinding::TimeUnitAssumed { name: "x".to_owned() }]);
    assert!(read_text(text).with_time("b").is_err());
    // By their numbers among all columns; afterwards channels are counted in the order of the file.
    assert_eq!(named("1"), read_text(text));
    assert_eq!(named("2"), by_x);
    let by_a = named("3");
    assert_eq!((by_a.channel_name("1"), by_a.channel_name("2")), (Ok("clock"), Ok("x")));
    assert_eq!(by_a.clone().with_time("1").unwrap().groups, read_text(text).groups);
    let last = read_text("x [mm],clock [ms],a\n1,0,5\n2,1000,7\n4,2000,9\n");
    let by_a = last.with_time("3").unwrap();
    assert_eq!((by_a.channel_name("1"), by_a.channel_name("2")), (Ok("x"), Ok("clock")));
}

#[test]
fn rate_that_disagrees_is_reported_with_the_rate_between_gaps() {
    // 10 Hz with a gap of 30 s among a hundred samples.
    let mut text = "Sampling rate: 20 Hz\ntime [s],x [m]\n".to_owned();
    for k in 0..100 {
        let t = 0.1 * f64::from(k) + if k < 50 { 0.0 } else { 30.0 };
        text.push_str(&format!("{t:.3},{k}\n"));
    }
    let found = read_text(&text).findings;
    let [RecordFinding::NamedRateDisagrees { found_hz, .. }] = found[..] else { panic!("{found:?}") };
    assert!((found_hz - 10.0).abs() < 1e-6, "{found:?}");
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
    assert_eq!(raw.findings, [RecordFinding::Latin1]);
    let wide: Vec<u8> = [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert_eq!(read(&wide).unwrap().groups[0].channels[0].unit.as_deref(), Some("µm"));
}

#[test]
fn time_without_title_or_unit_is_reported() {
    assert_eq!(read_text("0,1\n1,5\n2,4\n").findings, [RecordFinding::TimeAssumed]);
    assert_eq!(
        read_text("t,x\n0,1\n1,5\n").findings,
        [RecordFinding::TimeUnitAssumed { name: "t".to_owned() }]
    );
    // Two channels without a time: neither rises evenly.
    assert_eq!(read_text("3,1\n1,5\n2,4\n").groups[0].axis, TimeAxis::Unknown);
}

/// Velocities and other rates end in `/s`: they are not times, and a column named time comes first.
#[test]
fn column_named_time_is_the_time_whatever_is_measured_per_second() {
    for (titles, name, unit) in [
        ("time,speed m/s", "speed", "m/s"),
        ("time,v mm/s", "v", "mm/s"),
        ("t,v m/s", "v", "m/s"),
        ("Time[s],v m/s", "v", "m/s"),
        ("time,omega rad/s", "omega", "rad/s"),
        ("time,load N/s", "load", "N/s"),
        ("time,load_n_s", "load_n_s", ""),
        ("Time - s,delay ms", "delay", "ms"),
        ("Zeitstempel,a ms-2", "a", "ms-2"),
    ] {
        let unit = Some(unit).filter(|unit| !unit.is_empty());
        assert_read(
            &format!("{titles}\n0,5\n1,7\n2,9\n"),
            &[(name, unit)],
            &[0.0, 1.0, 2.0],
            &[5.0, 7.0, 9.0],
        );
    }
    // Without a name the unit decides.
    assert_read("v m/s,delay ms\n5,0\n7,1000\n", &[("v", Some("m/s"))], &[0.0, 1.0], &[5.0, 7.0]);
}

#[test]
fn rate_that_differs_from_that_of_the_times_is_reported() {
    let rows =
        |step: f64| -> String { (0..50).map(|k| format!("{},{}\n", step * f64::from(k), k % 7)).collect() };
    for (step, header, found) in [
        (0.002, "# sampling rate: 1000 Hz", true),
        (0.002, "Sampling rate: 1 kHz", true),
        (0.002, "# sampling rate: 500 Hz", false),
        (0.002, "# fs = 501", false),
    ] {
        let findings = read_text(&format!("{header}\nt [s],a\n{}", rows(step))).findings;
        let reported = matches!(
            findings[..],
            [RecordFinding::NamedRateDisagrees { named_hz: 1000.0, found_hz }]
                if (found_hz - 500.0).abs() < 1e-9
        );
        assert_eq!((reported, findings.len()), (found, usize::from(found)), "{header}: {findings:?}");
    }
    // A gap moves the mean rate, rounded times the median: neither is another rate.
    let gap = "# fs = 1\nt [s],a\n0,1\n1,2\n2,1\n3,2\n9,1\n";
    assert_eq!(read_text(gap).findings, []);
    let rounded: String = (0..60).map(|k| format!("{:.1},{}\n", f64::from(k) / 15.0, k % 7)).collect();
    assert_eq!(read_text(&format!("# fs = 15\nt [s],a\n{rounded}")).findings, []);
}

#[test]
fn sampling_rate_in_the_header_is_the_rate() {
    let raw = read_text("Sampling rate: 2 kHz\na [g]\n1.0\n2.0\n");
    assert_eq!(raw.groups[0].axis, TimeAxis::Even { step_s: 0.0005, start_s: 0.0 });
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
fn text_among_numbers_is_refused_with_its_position() {
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

/// A table of 400 rows of two columns with a line inserted before row `row`, from 1 on.
fn with_line(titles: &str, row: usize, line: &str) -> String {
    let mut rows: Vec<String> = (0..400).map(|k| format!("{}.5,{}.25", k, k % 7)).collect();
    rows.insert(row - 1, line.to_owned());
    format!("{titles}{}\n", rows.join("\n"))
}

/// At any line: the rows before it are not mistaken for a header.
#[test]
fn line_that_breaks_the_rows_is_refused_and_no_row_is_skipped() {
    for row in [2, 60, 150, 199, 250, 399] {
        for (titles, before) in [("time [s],a [g]\n", 1), ("", 0)] {
            let line = row + before;
            for (text, bad, column) in
                [("trigger", "trigger", 1), ("overload,", "overload", 1), ("7.5,abc", "abc", 2)]
            {
                assert_eq!(
                    refused(&with_line(titles, row, text)),
                    ReadError::NotANumber { line, column, text: bad.to_owned() },
                    "{text} in line {line}"
                );
            }
            for (text, found) in [("1,2,3", 3), ("7.5", 1)] {
                assert_eq!(
                    refused(&with_line(titles, row, text)),
                    ReadError::RaggedRow { line, found, expected: 2 },
                    "{text} in line {line}"
                );
            }
        }
    }
}

#[test]
fn first_row_that_is_too_short_is_refused() {
    assert_eq!(
        refused("t,a,b\n0,1\n1,2,3\n2,3,4\n3,4,5\n"),
        ReadError::RaggedRow { line: 2, found: 2, expected: 3 }
    );
    assert_eq!(refused("t,a\n0\n1,2\n2,3\n3,4\n"), ReadError::RaggedRow { line: 2, found: 1, expected: 2 });
    // Two tables below each other.
    let two = format!("t,a,b\n{}{}", "0.5,1.5\n".repeat(60), "0.5,1.5,2.5\n".repeat(100));
    assert_eq!(refused(&two), ReadError::RaggedRow { line: 2, found: 2, expected: 3 });
}

#[test]
fn single_number_above_the_titles_is_header() {
    assert_read(
        "400\n12:30:00\nt [s],a\n0,1\n1,2\n2,3\n",
        &[("a", None)],
        &[0.0, 1.0, 2.0],
        &[1.0, 2.0, 3.0],
    );
}

#[test]
fn empty_row_between_rows_is_a_missing_sample() {
    let raw = read_text("t [s],a\n0,1\n1,2\n,\n3,4\n4,5\n5,6\n6,7\n");
    assert_eq!(raw.groups[0].channels[0].samples.len(), 7);
    assert!(raw.groups[0].channels[0].samples[2].is_nan());
}

#[test]
fn files_without_numbers_are_refused() {
    assert_eq!(refused("only words\nand more\n"), ReadError::NoNumbers);
    assert_eq!(read(b"\x00\x01\x02\x03").unwrap_err(), ReadError::UnknownFormat);
}

#[test]
fn equal_names_get_numbers() {
    let raw = read_text("time [s],a,a,b,a,b\n0,1,2,3,4,5\n1,1,2,3,4,5\n");
    let names: Vec<&str> = raw.groups[0].channels.iter().map(|channel| channel.name.as_str()).collect();
    assert_eq!(names, ["a", "a (2)", "b", "a (3)", "b (2)"]);
}

#[test]
fn messages_show_the_start_of_a_long_field() {
    let error = refused(&format!("t,a\n0,1\n1,{}\n", "x".repeat(100_000)));
    assert_eq!(error, ReadError::NotANumber { line: 3, column: 2, text: format!("{}...", "x".repeat(60)) });
}

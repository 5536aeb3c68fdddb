use super::*;
use crate::{finding::RecordFinding, unit::MeasuredQuantity};

fn read(text: &str) -> Result<MeasuredTable, PointsError> {
    parse(text.as_bytes())
}

#[test]
fn columns_are_identified_by_their_units_and_become_si() {
    let table = read(
        "# a rig\nfrequency [Hz],max acc (g),tip displacement / mm,shaker [m/s^2],kind,period,remark\n\
         31.5,10,2,19.6,periodic,1,x\n\n50.8,,1.5,,chaotic,,\n",
    )
    .unwrap();
    let [first, second] = &table.points[..] else { panic!("{table:?}") };
    assert_eq!((first.frequency_hz, first.origin.as_str()), (31.5, "line 3"));
    // One rounding.
    assert!((first.maxima.acceleration.unwrap() - 98.0665).abs() < 1e-12);
    assert_eq!(first.maxima.displacement, Some(2e-3));
    assert_eq!(first.kind, MeasuredKind::Periodic { period_multiple: Some(1) });
    // 19.6 m/s² at 31.5 Hz: 19.6 / (2 pi 31.5)².
    let (quantity, amplitude) = first.excitation_amplitude().unwrap();
    assert_eq!(quantity, MeasuredQuantity::Displacement);
    assert!((amplitude - 5.003_4e-4).abs() < 1e-7, "{amplitude}");
    assert_eq!((second.maxima.acceleration, second.kind), (None, MeasuredKind::Aperiodic));
    assert!(matches!(&table.findings[..], [RecordFinding::LeftOut { name, .. }] if name == "remark"));
}

#[test]
fn spreadsheets_with_decimal_commas_are_read() {
    let table = read("\u{feff}Frequenz in Hz;acc in mm/s²;multiple\r\n31,5;2000,5;2\r\n").unwrap();
    assert_eq!(table.points[0].frequency_hz, 31.5);
    assert_eq!(table.points[0].maxima.acceleration, Some(2.0005));
    assert_eq!(table.points[0].kind, MeasuredKind::Periodic { period_multiple: Some(2) });
}

#[test]
fn columns_named_as_in_other_tables_of_the_program_are_read() {
    let table = read("frequency_hz,max_abs_displacement_m,max_contact_force_n\n20,1e-3,5\n").unwrap();
    assert_eq!(table.points[0].maxima.displacement, Some(1e-3));
    assert_eq!(table.points[0].maxima.force, Some(5.0));
    assert_eq!(table.points[0].kind, MeasuredKind::Unknown);
}

#[test]
fn every_fault_has_its_message() {
    let title = "frequency [Hz],acc [m/s^2],kind,period\n";
    for (text, part) in [
        (String::new(), "there is no table"),
        (title.to_owned(), "no row below it"),
        ("a [s],acc [m/s^2]\n1,2\n".to_owned(), "no column is the excitation frequency"),
        ("frequency [Hz],remark\n1,2\n".to_owned(), "no column is a maximum"),
        (
            "frequency [Hz],a [m/s^2],b [g]\n1,2,3\n".to_owned(),
            "\"a [m/s^2]\" and \"b [g]\" are both acceleration",
        ),
        ("frequency [Hz],acceleration\n1,2\n".to_owned(), "\"acceleration\" names no unit"),
        ("frequency,acc [g]\n1,2\n".to_owned(), "\"frequency\" names no unit"),
        ("frequency [Hz],acc [furlong]\n1,2\n".to_owned(), "unit \"furlong\", which is not known"),
        (format!("{title}30,1\n"), "line 2 has 2 fields, the titles have 4"),
        (format!("{title}30,x,,\n"), "line 2, column \"acc [m/s^2]\": \"x\" is not a number"),
        (format!("{title}30,-1,,\n"), "-1 must be finite and more than 0"),
        (format!("{title}0,1,,\n"), "0 must be finite and more than 0"),
        (format!("{title},1,,\n"), "line 2 has no excitation frequency"),
        (format!("{title}30,,,\n"), "line 2 has no maximum"),
        (format!("{title}30,1,odd,\n"), "the kind \"odd\" is not known"),
        (format!("{title}30,1,periodic,0\n"), "the period \"0\" must be a whole number"),
        (format!("{title}30,1,aperiodic,2\n"), "aperiodic and has the period 2"),
        ("a\0b".to_owned(), "it is no text"),
    ] {
        let message = read(&text).unwrap_err().to_string();
        assert!(message.contains(part), "{text:?}: {message}");
    }
}

use super::*;

fn drawn(inside: &str) -> Result<Vec<u8>, FigureError> {
    let svg = format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='10mm' \
         viewBox='0 0 40 20'>{inside}</svg>"
    );
    let characters = Characters { upright: "Aé".chars().collect(), ..Characters::default() };
    pdf(&svg, &characters, "a test", [20.0, 10.0])
}

#[test]
fn what_our_figures_do_not_have_is_refused() {
    assert!(drawn("<path d='M0 0h9v9z' fill='#123456'/><text x='1' y='9'>A</text>").is_ok());
    for other in [
        "<path d='M0 0h9v9z' fill='#123456' opacity='0.5' fill-opacity='0.5'/>",
        "<path d='M0 0h9v9z' fill='#123456' opacity='0.5'/>",
        "<g opacity='0.5'><text x='1' y='9'>A</text></g>",
        "<g style='mix-blend-mode:multiply'><path d='M0 0h9v9z'/></g>",
        "<defs><linearGradient id='g'><stop offset='0' stop-color='red'/>\
         <stop offset='1' stop-color='blue'/></linearGradient></defs><path d='M0 0h9v9z' fill='url(#g)'/>",
        "<defs><clipPath id='c'><path d='M0 0h4v4z'/></clipPath></defs>\
         <path d='M0 0h9v9z' clip-path='url(#c)'/>",
    ] {
        assert!(matches!(drawn(other), Err(FigureError::Rendering { .. })), "{other}");
    }
    assert!(matches!(
        pdf("no svg", &Characters::default(), "", [1.0; 2]),
        Err(FigureError::Rendering { .. })
    ));
}

/// The table at the end of the file has the offset of each object, and the file has no date.
#[test]
fn objects_stand_where_the_table_says_and_no_date_is_in_the_file() {
    let file = drawn("<text x='1' y='9'>Aé</text>").unwrap();
    let text = String::from_utf8_lossy(&file);
    assert!(text.starts_with("%PDF-1.7") && text.ends_with("%%EOF"));
    assert!(!text.contains("Date") && !text.contains("/ID"));
    let find = |start: usize, word: &[u8]| {
        start + file[start..].windows(word.len()).position(|part| part == word).unwrap()
    };
    let tail = std::str::from_utf8(&file[file.len() - 60..]).unwrap();
    let table: usize = tail.split("startxref").nth(1).unwrap().lines().nth(1).unwrap().parse().unwrap();
    assert_eq!(&file[table..table + 4], b"xref");
    let entries = std::str::from_utf8(&file[table..find(table, b"trailer")]).unwrap().lines().skip(3);
    let mut count = 0;
    for (number, entry) in (1..).zip(entries) {
        let at: usize = entry[..10].parse().unwrap();
        assert!(file[at..].starts_with(format!("{number} 0 obj").as_bytes()), "{number}");
        count = number;
    }
    assert_eq!(count, FIRST_OF_FACES + Face::OBJECTS - 1);
}

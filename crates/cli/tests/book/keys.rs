//! The tables of keys on the page of the study file are what the readers have.

use std::fs;

use hammerbeam_study::file::key_tables;

use super::{is_to_be_updated, root};

const END: &str = "<!-- end of keys -->";

fn start(table: &str) -> String {
    format!("<!-- keys: {table} -->")
}

/// The page with every table written anew between its marks.
fn written(page: &str) -> String {
    let mut page = page.to_owned();
    for table in key_tables() {
        let start = start(table.name);
        let (before, rest) = page.split_once(&start).unwrap_or_else(|| panic!("\"{start}\" is missing"));
        let (_, after) = rest.split_once(END).unwrap_or_else(|| panic!("\"{start}\" has no end"));
        page = format!("{before}{start}\n\n{}\n\n{END}{after}", table.markdown());
    }
    page
}

#[test]
fn the_tables_of_keys_are_what_the_readers_have() {
    let path = root().join("docs/reference/study-file.md");
    let page = fs::read_to_string(&path).unwrap();
    let expected = written(&page);
    if is_to_be_updated() {
        fs::write(&path, &expected).unwrap();
    }
    let page = fs::read_to_string(&path).unwrap();
    assert!(page == expected, "docs/reference/study-file.md is old; HAMMERBEAM_UPDATE=1 writes it");
    assert_eq!(page.matches("<!-- keys: ").count(), key_tables().len(), "a table that does not exist");
    let tables = page.lines().filter(|line| line.starts_with("| key")).count();
    assert_eq!(tables, key_tables().len(), "a table of keys by hand");
}

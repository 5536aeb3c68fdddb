//! Links of the pages beside the book lead to files and headings that are there; the build of the book looks
//! at those of its own pages.

use std::fs;

use super::root;

const PAGES: [&str; 5] = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "ARCHITECTURE.md", "SECURITY.md"];

/// Targets of the links and pictures of a page that are no addresses.
fn targets(page: &str) -> Vec<&str> {
    let targets = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.contains("://") && !target.starts_with("mailto:")).collect()
}

/// What a link calls the headings of a page: small letters, hyphens for spaces, without other signs.
fn anchors(page: &str) -> Vec<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| -> String {
        let kept = heading.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
        kept.chars().filter(|sign| sign.is_alphanumeric() || "-_".contains(*sign)).collect()
    };
    headings.map(anchor).collect()
}

/// What is wrong with a link of a page in the root of the project.
fn fault(page: &str, target: &str) -> Option<String> {
    let (file, heading) = target.split_once('#').unwrap_or((target, ""));
    let path = root().join(if file.is_empty() { page } else { file });
    if !path.exists() {
        return Some(format!("{page}: {file} is not there"));
    }
    let text = if heading.is_empty() { String::new() } else { fs::read_to_string(&path).unwrap() };
    let is_missing = !heading.is_empty() && !anchors(&text).iter().any(|known| known == heading);
    is_missing.then(|| format!("{page}: {target} has no such heading"))
}

#[test]
fn links_beside_the_book_lead_somewhere() {
    let mut count = 0;
    let mut faults = Vec::new();
    for page in PAGES {
        let text = fs::read_to_string(root().join(page)).unwrap();
        count += targets(&text).len();
        faults.extend(targets(&text).into_iter().filter_map(|target| fault(page, target)));
    }
    assert!(faults.is_empty(), "{faults:#?}");
    assert!(count > 40, "only {count} links were found");
}

#[test]
fn a_link_to_nothing_is_found() {
    let page = "[a](docs/how-to/nope.md), ![b](docs/images/page.png), [c](https://example.org/nope)";
    assert_eq!(targets(page), ["docs/how-to/nope.md", "docs/images/page.png"]);
    assert!(fault("README.md", "docs/how-to/nope.md").is_some());
    assert!(fault("README.md", "docs/reference/study-file.md#no-such-heading").is_some());
    assert_eq!(fault("README.md", "docs/reference/study-file.md#round-holes"), None);
    assert_eq!(fault("README.md", "#licence"), None);
}

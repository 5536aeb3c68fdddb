//! The HTML file: style sheet, data and script.

use serde_json::{Value, json};

use super::{
    columns,
    content::{Page, PageMesh, PageOutput, PageParameter, PageStop, PageStructure},
    measured, motions,
    orbits::{LEAST_BYTES, OrbitRecords},
};
use crate::{base64, style};

const SCRIPT: &str = include_str!("../../page/dist/page.js");
const LOOK: &str = include_str!("../../page/dist/page.css");
const LICENCE: &str = include_str!("../../page/dist/LICENCE-uPlot.txt");

/// Largest length of a page (bytes).
const MOST_BYTES: usize = 14_400_000;

/// A page without its orbits, whose numbers are packed.
#[derive(Debug, Clone)]
pub struct PackedPage {
    title: String,
    meta: Value,
    solutions: String,
    multipliers: String,
    figures: String,
}

impl PackedPage {
    pub(super) fn of(page: &Page) -> Self {
        Self {
            title: escaped(&page.title),
            meta: meta(page),
            solutions: base64::encode(&columns::pack(&page.branches, &page.outputs)),
            multipliers: base64::encode(&page.multipliers.bytes()),
            figures: in_script(&page.figures.documents().to_string()),
        }
    }

    /// Largest length of the records of orbits (bytes) that fits on the page.
    #[must_use]
    pub fn room_for_orbits(&self) -> usize {
        // Three bytes are four letters in base64.
        let without = self.html(&OrbitRecords::default()).len();
        (MOST_BYTES.saturating_sub(without) / 4 * 3).max(LEAST_BYTES)
    }

    /// The whole file, with these orbits.
    ///
    /// Equal pages give equal bytes. Numbers that are not finite are kept where the format allows; the page
    /// leaves them out.
    #[must_use]
    pub fn html(&self, orbits: &OrbitRecords) -> String {
        let Self { title, meta, solutions, multipliers, figures } = self;
        let mut meta = meta.clone();
        meta["orbits"] = json!({ "solutions": orbits.solutions(), "lengths": orbits.lengths() });
        let meta = in_script(&meta.to_string());
        let orbits = base64::encode(&orbits.bytes());
        [
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n",
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
            "<link rel=\"icon\" href=\"data:,\">\n",
            &format!("<title>{title}</title>\n"),
            "<!-- This page holds uPlot under this licence:\n",
            LICENCE,
            "-->\n<style>\n",
            LOOK,
            "</style>\n</head>\n<body>\n<div id=\"page\"></div>\n",
            "<noscript>This page draws with a script that it holds itself; ",
            "scripts are switched off in this browser.</noscript>\n",
            &format!("<script id=\"meta\" type=\"application/json\">{meta}</script>\n"),
            &format!("<script id=\"solutions\" type=\"text/plain\">{solutions}</script>\n"),
            &format!("<script id=\"floquet\" type=\"text/plain\">{multipliers}</script>\n"),
            &format!("<script id=\"orbits\" type=\"text/plain\">{orbits}</script>\n"),
            &format!("<script id=\"drawings\" type=\"application/json\">{figures}</script>\n"),
            "<script>\n",
            SCRIPT,
            "</script>\n</body>\n</html>\n",
        ]
        .concat()
    }
}

/// Everything but solutions, multipliers, orbits and figures.
fn meta(page: &Page) -> Value {
    let mut first = 0;
    let branches = page.branches.iter().map(|branch| {
        let count = branch.solutions.len();
        first += count;
        json!({
            "id": branch.id,
            "period": branch.period_multiple,
            "ends": branch.ends,
            "first": first - count,
            "count": count,
            "over": branch.over,
        })
    });
    let branches: Vec<Value> = branches.collect();
    json!({
        "title": page.title,
        "point": page.point,
        "range": page.frequency_range_hz,
        "notice": page.notice,
        "branches": branches,
        "parameters": parameters(page),
        "outputs": page.outputs.iter().map(output).collect::<Vec<_>>(),
        "folder": page.folder_name,
        "multipliers": { "solutions": page.multipliers.count(), "most": page.multipliers.most() },
        "structure": page.structure.as_ref().map(structure),
        "motions": page.motions.iter().map(motions::motion).collect::<Vec<_>>(),
        "chaos": page.chaotic_ranges_hz,
        "sections": motions::sections(&page.sections),
        "measured": page.measured.iter().map(measured::series).collect::<Vec<_>>(),
        "figures": page.figures.list(),
        "look": { "light": style::page_colours(false), "dark": style::page_colours(true) },
    })
}

fn output(output: &PageOutput) -> Value {
    json!({ "title": output.title, "unit": output.unit })
}

/// The parameters, each with the unit that suits the values of its branches.
fn parameters(page: &Page) -> Vec<Value> {
    let describe = |(place, PageParameter { axis, frequency_hz }): (usize, &PageParameter)| {
        let own = page.branches.iter().filter(|branch| branch.over as usize == place + 1);
        let values = own.flat_map(|branch| &branch.solutions).map(|solution| solution.parameter.abs());
        let unit = axis.unit_up_to(values.filter(|value| value.is_finite()).fold(0.0, f64::max));
        json!({
            "title": axis.title,
            "si": axis.unit,
            "unit": unit.symbol,
            "factor": unit.factor,
            "frequency": frequency_hz,
        })
    };
    page.parameters.iter().enumerate().map(describe).collect()
}

fn structure(structure: &PageStructure) -> Value {
    let places = structure.places.iter().map(|place| {
        json!({ "name": place.name, "at": place.at, "shape": place.shape, "support": place.support_ratios })
    });
    let links = structure.links.iter().map(|link| json!({ "ends": link.ends, "damper": link.is_damper }));
    json!({
        "beam": structure.is_beam,
        "places": places.collect::<Vec<_>>(),
        "stops": structure.stops.iter().map(stop).collect::<Vec<_>>(),
        "links": links.collect::<Vec<_>>(),
        "eigenfrequencies": structure.eigenfrequencies_hz,
        "supports": structure.supports,
        "ground": structure.ground,
        "mesh": structure.mesh.as_ref().map(mesh),
    })
}

fn mesh(mesh: &PageMesh) -> Value {
    json!({
        "nodes": mesh.nodes,
        "shapes": mesh.shapes,
        "support": mesh.support_ratios,
        "lines": mesh.lines,
        "places": mesh.places,
    })
}

fn stop(stop: &PageStop) -> Value {
    let levels = stop.levels.iter().map(|(level, above)| json!({ "level": level, "above": above }));
    json!({
        "name": stop.name,
        "element": stop.element,
        "place": stop.place,
        "other": stop.other,
        "rides": stop.rides,
        "levels": levels.collect::<Vec<_>>(),
    })
}

/// Text between tags.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// JSON that cannot close the script element around it.
fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::content::{PageBranch, PageSolution};

    #[test]
    fn a_title_cannot_break_out_of_its_place() {
        let page = Page { title: "</script><b>&".to_owned(), ..Page::default() };
        let html = page.pack().html(&OrbitRecords::default());
        assert!(html.contains("<title>&lt;/script&gt;&lt;b&gt;&amp;</title>"));
        assert!(html.contains(r#""title":"\u003c/script>\u003cb>&""#));
    }

    #[test]
    fn branches_know_where_their_solutions_begin() {
        let branch = |count: usize| PageBranch {
            solutions: vec![PageSolution::default(); count],
            ..PageBranch::default()
        };
        let page = Page { branches: vec![branch(3), branch(0), branch(2)], ..Page::default() };
        let meta = meta(&page);
        let firsts: Vec<u64> = (0..3).map(|k| meta["branches"][k]["first"].as_u64().unwrap()).collect();
        assert_eq!(firsts, [0, 3, 3]);
    }

    /// The script uses no network and cannot close its element.
    #[test]
    fn the_script_stays_in_its_element_and_loads_nothing() {
        assert!(!SCRIPT.contains("</script") && !LOOK.contains("</style") && !LICENCE.contains("-->"));
        for word in ["fetch(", "XMLHttpRequest", "WebSocket", "import("] {
            assert!(!SCRIPT.contains(word), "{word}");
        }
        assert!(!LOOK.contains("url("));
    }
}

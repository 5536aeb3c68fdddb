//! Every table of the study file with its keys: what the page of keys of the book prints.

use std::fmt::Write;

use crate::document::KeyRow;

use super::{
    beam, beam_point, beam_section, beam_span, continuation, damping, excitation, figures, force, load,
    lumped, matrices, output, reduction, response, rig, search, stop_keys, support_motion, vary,
};

/// A table of the study file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeyTable {
    /// What the page calls it: its header in the study file, with its kind where it has several.
    pub name: &'static str,
    /// Its keys.
    pub rows: Vec<KeyRow>,
}

impl KeyTable {
    /// The table in Markdown, without a line at its end.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut text = "| key | allowed | default | meaning |\n|---|---|---|---|".to_owned();
        for KeyRow { name, of, allowed, default, meaning } in &self.rows {
            let of = if of.is_empty() { String::new() } else { format!(" of {of}") };
            // A `String` takes everything.
            let _ = write!(text, "\n| `{name}`{of} | {allowed} | {default} | {meaning} |");
        }
        text
    }
}

/// All tables, in the order of the page.
#[must_use]
pub fn key_tables() -> Vec<KeyTable> {
    let table = |name, rows| KeyTable { name, rows };
    vec![
        table("top level", rows_of_top_level()),
        table("structure of kind beam", beam::rows()),
        table("structure.section", beam_section::rows()),
        table("structure.span", beam_span::rows()),
        table("structure.point of a beam", beam_point::rows()),
        table("structure of kind lumped", lumped::rows()),
        table("structure.mass", lumped::rows_of_mass()),
        table("structure.spring", lumped::rows_of_spring()),
        table("structure.damper", lumped::rows_of_damper()),
        table("structure of kind matrices", matrices::rows()),
        table("structure.component", matrices::rows_of_component()),
        table("structure.point of matrices", matrices::rows_of_point()),
        table("structure.support", matrices::rows_of_support()),
        table("structure.fixed", matrices::rows_of_fixed()),
        table("reduction", reduction::rows()),
        table("damping", damping::rows()),
        table("damping.rayleigh", damping::rows_of_rayleigh()),
        table("excitation", excitation::rows()),
        table("excitation.support", support_motion::rows()),
        table("excitation.force", force::rows()),
        table("load", load::rows()),
        table("stop", stop_keys::rows()),
        table("stop by its law", stop_keys::rows_of_laws()),
        table("response", response::rows()),
        table("output", output::rows()),
        table("search", search::rows()),
        table("continuation", continuation::rows()),
        table("vary", vary::rows_of_vary()),
        table("curve", vary::rows_of_curve()),
        table("figures", figures::rows()),
        table("figures.orbit", figures::rows_of_orbit()),
        table("rig", rig::rows()),
    ]
}

fn rows_of_top_level() -> Vec<KeyRow> {
    let row = |name, allowed, default, meaning| KeyRow::read_apart(name, allowed, default, meaning);
    let table = |name, meaning| row(name, "table", "every default", meaning);
    let list = |name, meaning| row(name, "list of tables", "none", meaning);
    vec![
        row("title", "text", "`\"\"`", "title of reports and figures"),
        row("structure", "table", "required", "the linear structure"),
        row("reduction", "table", "required but for a lumped structure", "which modes are kept"),
        row("damping", "table", "none", "damping of the modes"),
        row("excitation", "table", "none", "what shakes the structure, and the frequency range"),
        list("load", "gravity and further loads"),
        list("stop", "stops, contacts, gaps and local springs"),
        table("response", "what is to be computed"),
        list("output", "what is read off the stored orbits"),
        table("search", "how thoroughly branches are looked for"),
        table("continuation", "how finely branches are followed"),
        list("vary", "branches in other parameters"),
        list("curve", "curves of bifurcations in two parameters"),
        row("figures", "table", "none", "orbits that are drawn, and the filter for their accelerations"),
        row("rig", "table", "none", "a virtual rig, see [`[rig]`](#rig)"),
    ]
}

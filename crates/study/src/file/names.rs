//! The names of a structure, and references to them.

use hammerbeam_structure::Plane;

use crate::document::{TomlTable, Value};

use super::beam_end::EndSupport;

/// Everything a study may refer to by name.
#[derive(Debug, Default)]
pub(super) struct Names {
    /// Points and masses: where motion is observed and forces act.
    points: Vec<String>,
    /// Ends of a beam; they are observed like points.
    ends: Vec<(&'static str, Option<EndSupport>)>,
    /// Whether the ground is a support that can move.
    ground: bool,
    /// Supports by name, of a structure that has such.
    supports: Option<Vec<String>>,
}

/// Names with a meaning of their own.
const RESERVED: [&str; 5] = ["left", "right", "ground", "space", "support"];

impl Names {
    pub(super) fn add_beam_ends(&mut self, left: Option<EndSupport>, right: Option<EndSupport>) {
        self.ends = vec![("left", left), ("right", right)];
    }

    /// Every point of the beam is two, one in each plane.
    pub(super) fn in_two_planes(&mut self) {
        let both = |point: &String| Plane::BOTH.map(|plane| plane.name_of(point));
        self.points = self.points.iter().flat_map(both).collect();
        let held = |end: &str| self.ends.iter().find(|(name, _)| *name == end).and_then(|(_, held)| *held);
        let (left, right) = (held("left"), held("right"));
        self.ends = vec![("left.y", left), ("left.z", left), ("right.y", right), ("right.z", right)];
    }

    pub(super) fn add_ground(&mut self) {
        self.ground = true;
    }

    /// The structure has supports with names of their own.
    pub(super) fn add_supports(&mut self) {
        self.supports = Some(Vec::new());
    }

    /// Adds a support; whether its name is new, not empty and not reserved.
    pub(super) fn add_support(&mut self, value: &Value<'_>, name: &str) -> bool {
        let supports = self.supports.get_or_insert_default();
        let taken = supports.iter().chain(&self.points).any(|other| other == name);
        // The ends of a beam and the ground are what supports are called elsewhere.
        let reserved = ["space", "support"];
        if taken || name.trim().is_empty() || reserved.contains(&name) {
            let help = format!("allowed: a name of its own, not one of {}", reserved.join(", "));
            value.problem(format!("`name` is \"{name}\", which is taken, empty or reserved"), vec![help]);
            return false;
        }
        supports.push(name.to_owned());
        true
    }

    /// Adds a point that the study does not name itself.
    pub(super) fn add_point(&mut self, name: &str) {
        self.points.push(name.to_owned());
    }

    /// Points, masses and beam ends.
    pub(super) fn observable(&self) -> Vec<&str> {
        self.points.iter().map(String::as_str).chain(self.ends.iter().map(|(name, _)| *name)).collect()
    }

    /// Ends of a beam that are clamped or pinned.
    pub(super) fn held_ends(&self) -> Vec<&str> {
        let held = self.ends.iter().filter(|(_, end)| end.is_some_and(EndSupport::holds_displacement));
        held.map(|(name, _)| *name).collect()
    }

    /// The right end of a beam, in its first plane.
    pub(super) fn right_end(&self) -> &str {
        self.ends.iter().map(|(name, _)| *name).find(|name| name.starts_with("right")).unwrap_or("right")
    }

    /// The first point or mass.
    pub(super) fn first(&self) -> Option<&str> {
        self.points.first().map(String::as_str)
    }

    /// A reference to a point, a mass or a beam end.
    pub(super) fn point(&self, value: &Value<'_>) -> Option<String> {
        let known = self.observable();
        self.known(value, &known, "a point of this structure")
    }

    /// A reference to what can be moved by the excitation: a held beam end, a point, a mass, the ground.
    pub(super) fn support(&self, value: &Value<'_>) -> Option<String> {
        if let Some(supports) = &self.supports {
            let known: Vec<&str> = supports.iter().map(String::as_str).collect();
            return self.known(value, &known, "a support of this structure");
        }
        let mut known = self.observable();
        known.extend(self.ground.then_some("ground"));
        let name = self.known(value, &known, "a support of this structure")?;
        let end = self.ends.iter().find(|(end, _)| *end == name).and_then(|(_, end)| *end);
        if end.is_some_and(|end| !end.holds_displacement()) {
            let message =
                format!("the {name} end of the beam is not held, so its motion cannot be prescribed");
            value.problem(message, vec![format!("allowed: {name} = \"clamped\" or \"pinned\"")]);
            return None;
        }
        Some(name)
    }

    /// Two different points or masses; also the ground if `with_ground`.
    pub(super) fn pair(&self, value: &Value<'_>, with_ground: bool) -> Option<[String; 2]> {
        let mut known = self.observable();
        if with_ground {
            known.push("ground");
        }
        let pair = value.exactly::<2, String>("2 names", |name| self.known(name, &known, "a known name"))?;
        if pair[0] == pair[1] {
            value.problem(
                format!("`between` names \"{}\" twice", pair[0]),
                vec!["allowed: two different names".into()],
            );
            return None;
        }
        Some(pair)
    }

    fn known(&self, value: &Value<'_>, known: &[&str], what: &str) -> Option<String> {
        let name = value.text()?;
        if self.kind_is_known() && !known.contains(&name) {
            value.unknown_word(name, what, known);
            return None;
        }
        Some(name.to_owned())
    }

    /// Without the kind of the structure there are no names, and references are not judged.
    fn kind_is_known(&self) -> bool {
        self.ground || !self.ends.is_empty() || self.supports.is_some()
    }
}

/// The `name` of a point or a mass: new, not empty, not reserved.
pub(super) fn read_name(table: &TomlTable<'_>, names: &mut Names) -> Option<String> {
    let value = table.required("name")?;
    let name = value.text()?;
    let fault = if name.trim().is_empty() {
        Some("`name` is empty".to_owned())
    } else if RESERVED.contains(&name) {
        Some(format!("`name` is \"{name}\", which is reserved"))
    } else if names.points.iter().any(|other| other == name) {
        Some(format!("`name` is \"{name}\", which is already taken"))
    } else {
        None
    };
    if let Some(message) = fault {
        value.problem(
            message,
            vec![format!("allowed: a name of its own, not one of {}", RESERVED.join(", "))],
        );
        return None;
    }
    names.points.push(name.to_owned());
    Some(name.to_owned())
}

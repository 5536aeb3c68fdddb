//! Bending in two planes that do not couple, as of a tube or a shaft.
//!
//! A section with the same second moment in every direction bends in the planes `y` and `z` alike, so with
//! the mass-normalised modes `phi_i` of one plane the displacements are `y = Phi q_y` and `z = Phi q_z`, and
//!
//! `q_y'' + C q_y' + diag(w^2) q_y = Phi^T f_y`, `q_z'' + C q_z' + diag(w^2) q_z = Phi^T f_z`.
//!
//! The modal coordinates alternate, `[q_y1, q_z1, q_y2, q_z2, ...]`: every eigenfrequency occurs twice, and
//! each mode lies in one plane. Any other basis of a pair, turned by an angle, would do as well; this one
//! keeps the planes apart, so a motion that starts in a plane, and is driven in it, stays there to the last
//! bit.
//!
//! A point `tip` is the two points `tip.y` and `tip.z`. What holds or moves a point holds it in both planes:
//! where the excitation moves `left.y` alone, `left.z` stands still.

use faer::Mat;

use crate::{
    Damping, FlexibilityError, FrequencyError, ModeTables, OutlinePoint, Plane, PointOutput, Reduced,
    ReducedModel, Reduction, Structure, StructureError, SupportInput,
};

/// A structure that bends in two planes alike.
#[derive(Debug, Clone)]
pub struct TwoPlanes {
    one: Structure,
}

impl TwoPlanes {
    /// From the structure in one plane.
    #[must_use]
    pub fn new(one: Structure) -> Self {
        Self { one }
    }

    /// Moves supports, and reduces the structure as [`Structure::reduce`] does in one plane.
    ///
    /// * `supports`: what each support moves, by the names of points in their planes.
    /// * `damping`: ratios for each mode are those of one plane.
    /// * `interface`: names of points in their planes.
    ///
    /// # Errors
    /// As [`Structure::reduce`] and [`Structure::with_support_motions`]; a point without a plane is unknown.
    pub fn reduce(
        &self,
        supports: &[&[&str]],
        reduction: &Reduction,
        damping: &Damping,
        interface: &[&str],
    ) -> Result<Reduced, StructureError> {
        let moved = supports.iter().map(|names| self.split("support motion", names));
        let moved: Vec<Vec<(&str, Plane)>> = moved.collect::<Result<_, _>>()?;
        let (mut places, mut twice) = (Vec::new(), Vec::new());
        for moved in moved.iter().flatten() {
            if twice.contains(moved) {
                let names = vec![moved.1.name_of(moved.0)];
                return Err(StructureError::MovedTwice { names });
            }
            twice.push(*moved);
            if !places.contains(&moved.0) {
                places.push(moved.0);
            }
        }
        let each: Vec<[&str; 1]> = places.iter().map(|place| [*place]).collect();
        let each: Vec<&[&str]> = each.iter().map(<[&str; 1]>::as_slice).collect();
        let interface: Vec<&str> =
            self.split("the interface", interface)?.into_iter().map(|(point, _)| point).collect();
        let one = self.one.clone().with_support_motions(&each)?;
        let one = one.reduce(reduction, damping, &interface)?;
        let place = |name: &str| places.iter().position(|place| *place == name);
        let of_support = |moved: &Vec<(&str, Plane)>| {
            moved.iter().filter_map(|(name, plane)| Some((place(name)?, *plane))).collect()
        };
        Ok(doubled(&one, &Supports { places_of: moved.iter().map(of_support).collect() }))
    }

    fn split<'a>(&self, what: &str, names: &[&'a str]) -> Result<Vec<(&'a str, Plane)>, StructureError> {
        let known = || {
            let both = |point: &str| Plane::BOTH.map(|plane| plane.name_of(point));
            self.one.point_names().flat_map(both).collect()
        };
        let unknown = |name: &str| StructureError::UnknownPoint {
            what: what.into(),
            name: name.into(),
            known: known(),
        };
        names.iter().map(|name| Plane::split(name).ok_or_else(|| unknown(name))).collect()
    }
}

/// The places that each support moves, by their numbers among the supports in one plane, with the planes.
struct Supports {
    places_of: Vec<Vec<(usize, Plane)>>,
}

impl Supports {
    /// Displacements in a plane per unit of each support, from those per unit of each place.
    fn ratios(&self, plane: Plane, of_places: &[f64]) -> Vec<f64> {
        let of = |places: &Vec<(usize, Plane)>| {
            places.iter().filter(|(_, own)| *own == plane).map(|(place, _)| of_places[*place]).sum()
        };
        self.places_of.iter().map(of).collect()
    }

    /// What each support drives, from what each place drives in one plane.
    fn inputs(&self, of_places: &[SupportInput], modes: usize) -> Vec<SupportInput> {
        let input = |places: &Vec<(usize, Plane)>| {
            let sum = |of: fn(&SupportInput) -> &Vec<f64>| {
                let mut sum = vec![0.0; 2 * modes];
                for (place, plane) in places {
                    let own = plane.spread(of(&of_places[*place]));
                    sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
                }
                sum
            };
            SupportInput { inertia: sum(|own| &own.inertia), damping: sum(|own| &own.damping) }
        };
        self.places_of.iter().map(input).collect()
    }
}

fn doubled(one: &Reduced, supports: &Supports) -> Reduced {
    let n = one.model.dof();
    let damping =
        Mat::from_fn(
            2 * n,
            2 * n,
            |i, j| {
                if i % 2 == j % 2 { one.model.damping[(i / 2, j / 2)] } else { 0.0 }
            },
        );
    let of_point = |point: &PointOutput| {
        Plane::BOTH.map(|plane| PointOutput {
            name: plane.name_of(&point.name),
            shape: plane.spread(&point.shape),
            support_ratios: supports.ratios(plane, &point.support_ratios),
        })
    };
    let outline = Plane::BOTH.into_iter().flat_map(|plane| {
        one.outline.iter().map(move |place| OutlinePoint {
            at: place.at,
            plane,
            shape: plane.spread(&place.shape),
            support_ratios: supports.ratios(plane, &place.support_ratios),
        })
    });
    let model = ReducedModel {
        natural_frequencies: twice(&one.model.natural_frequencies),
        damping,
        points: one.model.points.iter().flat_map(of_point).collect(),
        supports: supports.inputs(&one.model.supports, n),
        uniform_acceleration: Plane::Y.spread(&one.model.uniform_acceleration),
    };
    Reduced { model, tables: both_tables(&one.tables), outline: outline.collect(), mesh: None }
}

/// Every entry twice.
fn twice<T: Clone>(values: &[T]) -> Vec<T> {
    values.iter().flat_map(|value| [value.clone(), value.clone()]).collect()
}

fn both_tables(one: &ModeTables) -> ModeTables {
    let of_point = |error: &FlexibilityError| {
        Plane::BOTH.map(|plane| FlexibilityError { point: plane.name_of(&error.point), ..error.clone() })
    };
    ModeTables {
        clamped_hz: twice(&one.clamped_hz),
        free_interface_hz: twice(&one.free_interface_hz),
        fixed_interface_hz: twice(&one.fixed_interface_hz),
        reduced_hz: twice(&one.reduced_hz),
        frequency_errors: twice::<FrequencyError>(&one.frequency_errors),
        flexibility_errors: one.flexibility_errors.iter().flat_map(of_point).collect(),
    }
}

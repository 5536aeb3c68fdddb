//! Random studies, the same ones from the same seed: one to three masses, springs, dampers, loads, one to
//! three stops of any law.
//!
//! Numbers are of the order of one in units of a mass, a spring and a force, so that contacts matter; what a
//! study means in other units is a matter of [`relations`](crate::relations).

use std::fmt::Write as _;

use crate::attractors::Random;

/// A study of few solutions.
#[must_use]
pub fn random_study(seed: u64) -> String {
    let mut random = Random::new(seed);
    // The first numbers of neighbouring seeds are alike.
    (0..8).for_each(|_| _ = random.part());
    let masses = 1 + pick(&mut random, 3);
    let mut text = structure(masses, &mut random);
    let low_hz = between(&mut random, 0.08, 0.3);
    let range_hz = [low_hz, 1.35 * low_hz];
    text += &excitation(masses, range_hz, &mut random);
    let stops = [1, 1, 1, 2, 2, 3][pick(&mut random, 6)];
    for _ in 0..stops {
        text += &stop(masses, &mut random);
    }
    let step = (range_hz[1] - range_hz[0]) / 100.0;
    text + "[response]\nperiod_multiples = [1, 2]\n\n\
        [search]\nfrequencies = 2\nstarts = 2\ntrials = 2\n\n\
        [continuation]\nbudget_solutions = 1500\n"
        + &format!("max_step_hz = {step}\n")
}

fn structure(masses: usize, random: &mut Random) -> String {
    let damper = 0.05 + 0.15 * random.part();
    let mut text = "[structure]\nkind = \"lumped\"\n\n".to_owned();
    for number in 1..=masses {
        let mass = between(random, 0.4, 2.0);
        _ = write!(text, "[[structure.mass]]\nname = \"{number}\"\nmass_kg = {mass}\n\n");
        let (spring, damping) = (between(random, 0.5, 2.0), damper * between(random, 0.5, 2.0));
        _ = write!(
            text,
            "[[structure.spring]]\nbetween = [\"{number}\", \"ground\"]\nstiffness_n_m = {spring}\n\n"
        );
        _ = write!(
            text,
            "[[structure.damper]]\nbetween = [\"{number}\", \"ground\"]\ndamping_n_s_m = {damping}\n\n"
        );
    }
    for number in 2..=masses {
        let (before, spring) = (number - 1, between(random, 0.3, 3.0));
        _ = write!(
            text,
            "[[structure.spring]]\nbetween = [\"{before}\", \"{number}\"]\nstiffness_n_m = {spring}\n\n"
        );
    }
    text
}

fn excitation(masses: usize, [low, high]: [f64; 2], random: &mut Random) -> String {
    let range = format!("frequency_hz = [{low}, {high}]");
    let (size, phase) = (between(random, 0.3, 1.0), between(random, 0.0, 6.0));
    let mut text = if random.part() < 0.3 {
        format!(
            "[excitation]\nkind = \"support-motion\"\nat = \"ground\"\namplitude_m = \
            {size}\n{range}\nphase_rad = {phase}\n\n"
        )
    } else {
        let at = 1 + pick(random, masses);
        format!(
            "[excitation]\nkind = \"force\"\nat = \"{at}\"\namplitude_n = {size}\n{range}\nphase_rad = \
            {phase}\n\n"
        )
    };
    if random.part() < 0.3 {
        let weight = between(random, -0.3, 0.3);
        _ = write!(text, "[[load]]\nkind = \"gravity\"\nacceleration_m_s2 = {weight}\n\n");
    }
    if random.part() < 0.2 {
        let (at, force) = (1 + pick(random, masses), between(random, 0.05, 0.3));
        _ = write!(text, "[[load]]\nkind = \"force\"\nat = \"{at}\"\namplitude_n = {force}\norder = 2\n\n");
    }
    text
}

/// A stop at a mass or between two of them.
fn stop(masses: usize, random: &mut Random) -> String {
    let mut text = "[[stop]]\n".to_owned();
    let at = 1 + pick(random, masses);
    if masses > 1 && random.part() < 0.4 {
        let other = 1 + at % masses;
        _ = writeln!(text, "between = [\"{at}\", \"{other}\"]");
    } else {
        _ = writeln!(text, "at = \"{at}\"");
    }
    let gap = if random.part() < 0.2 { 0.0 } else { between(random, 0.1, 1.2) };
    let side = ["above", "below"][pick(random, 2)];
    let stiffness = between(random, 1.0, 40.0);
    let (loss, restitution) = (between(random, 0.05, 0.8), between(random, 0.4, 0.95));
    let one_sided = format!("gap_m = {gap}\nside = \"{side}\"\n");
    let preload = between(random, 0.1, 0.8);
    text += &match pick(random, 9) {
        0 => format!("law = \"hertz\"\nstiffness_n_m15 = {stiffness}\n{one_sided}"),
        1 => format!("law = \"linear\"\nstiffness_n_m = {stiffness}\n{one_sided}"),
        2 => format!("law = \"linear\"\nstiffness_n_m = {stiffness}\ndamping_n_s_m = {loss}\n{one_sided}"),
        3 => format!(
            "law = \"linear\"\nstiffness_n_m = {stiffness}\npreload_n = {preload}\nside = \"{side}\"\n"
        ),
        4 => {
            format!("law = \"hunt-crossley\"\nstiffness_n_m15 = {stiffness}\nloss_s_m = {loss}\n{one_sided}")
        }
        5 => format!(
            "law = \"lankarani-nikravesh\"\nstiffness_n_m15 = {stiffness}\nrestitution = \
            {restitution}\n{one_sided}"
        ),
        6 => format!("law = \"rigid\"\nrestitution = {restitution}\n{one_sided}"),
        7 => format!("law = \"two-sided\"\nstiffness_n_m = {stiffness}\ngap_m = {gap}\n"),
        _ => format!("law = \"cubic\"\nstiffness_n_m3 = {}\n", 0.2 * loss),
    };
    text + "\n"
}

fn pick(random: &mut Random, count: usize) -> usize {
    ((random.part() * count as f64) as usize).min(count - 1)
}

fn between(random: &mut Random, low: f64, high: f64) -> f64 {
    low + (high - low) * random.part()
}

#[cfg(test)]
mod tests {
    use super::*;
    use hammerbeam_study::StudyFile;

    #[test]
    fn every_random_study_is_a_study_and_none_is_like_another() {
        let studies: Vec<String> = (0..500).map(random_study).collect();
        for (seed, text) in studies.iter().enumerate() {
            let file = StudyFile::parse("study.toml", text.clone());
            assert!(file.is_ok(), "seed {seed}: {}\n{text}", file.unwrap_err());
            assert!(!studies[..seed].contains(text), "seed {seed}");
        }
    }
}

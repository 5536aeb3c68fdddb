//! Files of public projects, where a checkout has them beside it (`../shared/structures`): the frequencies
//! that are known of them.

use std::path::{Path, PathBuf};

use hammerbeam_matrices::{ComponentFiles, MatrixFile, read_component, read_matrices};
use hammerbeam_structure::{Damping, Matrices, MatrixComponent, Reduced, Reduction};

/// The folder, or `None` with a word about it.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/structures");
    if !folder.is_dir() {
        #[expect(clippy::print_stderr, reason = "a test that did not run says so")]
        {
            eprintln!("skipped: {} is not there", folder.display());
        }
        return None;
    }
    Some(folder)
}

fn component(stiffness: PathBuf, mass: PathBuf, labels: Option<PathBuf>, factor: f64) -> MatrixComponent {
    let files = ComponentFiles {
        name: String::new(),
        format: None,
        stiffness: MatrixFile { path: stiffness, matrix: None, factor },
        mass: MatrixFile { path: mass, matrix: None, factor: 1.0 },
        damping: None,
        labels,
    };
    read_component(&files).unwrap_or_else(|error| panic!("{error}"))
}

fn modes(components: Vec<MatrixComponent>, cut_off_hz: f64) -> Reduced {
    let matrices = Matrices::new(components, 1 << 30);
    let reduction = Reduction::Truncation { cut_off_hz };
    matrices.reduce(&[], &reduction, &Damping::none(), &[]).unwrap_or_else(|error| panic!("{error}")).0
}

/// Frequencies to half a unit of the last printed digit, after so many rigid-body modes.
#[track_caller]
fn assert_printed(reduced: &Reduced, rigid: usize, printed: &[&str]) {
    let found = &reduced.tables.clamped_hz;
    assert!(found[..rigid].iter().all(|frequency| *frequency == 0.0), "{found:?}");
    for (found, printed) in found[rigid..].iter().zip(printed) {
        let decimals = printed.split('.').nth(1).map_or(0, str::len) as i32;
        let half = 0.501 * 10.0_f64.powi(-decimals);
        assert!((found - printed.parse::<f64>().unwrap()).abs() <= half, "{found} {printed}");
    }
}

#[test]
fn abaqus_block_and_rotor() {
    let Some(folder) = shared().map(|folder| folder.join("abaqus")) else { return };
    let at = |name: &str| folder.join(name);
    let block =
        component(at("blockC3D8_STIF1.mtx"), at("blockC3D8_MASS1.mtx"), Some(at("blockC3D8.inp")), 1.0);
    assert_printed(&modes(vec![block], 500.0), 6, &["438.775166"]);
    let rotor = component(at("rotorDiscTestSTIF1.mtx"), at("rotorDiscTestMASS1.mtx"), None, 1e-2);
    let printed = ["104.637013", "104.637013", "187.824", "212.330", "224.552", "238.688"];
    assert_printed(&modes(vec![rotor], 250.0), 6, &printed);
}

#[test]
fn calculix_beam() {
    let Some(folder) = shared().map(|folder| folder.join("calculix")) else { return };
    let at = |name: &str| folder.join(name);
    let beam = component(at("b32.sti"), at("b32.mas"), Some(at("b32.dof")), 1.0);
    assert_printed(&modes(vec![beam], 2000.0), 0, &["221.9151", "429.9326", "1444.921"]);
}

#[test]
fn nastran_punch() {
    let Some(folder) = shared().map(|folder| folder.join("nastran-punch")) else { return };
    let file = folder.join("sol103_swept_plane.pch1");
    let plane = component(file.clone(), file, None, 1.0);
    assert_printed(&modes(vec![plane], 6.0), 3, &["1.339207", "3.406026", "5.610046"]);
}

#[test]
fn nastran_superelements_coupled() {
    let Some(folder) = shared().map(|folder| folder.join("nastran-op4")) else { return };
    let at = |name: &str| folder.join(name);
    let part = |name: &str| {
        let (matrices, order) = (at(&format!("{name}.op4")), at(&format!("{name}.pch")));
        component(matrices.clone(), matrices, Some(order), 1.0)
    };
    let coupled = modes(vec![part("inboard"), part("outboard")], 44.0);
    assert_printed(&coupled, 6, &["1.698800", "1.767487", "1.857720", "3.419612"]);
    assert!((coupled.tables.clamped_hz[22] - 43.08660).abs() < 5.01e-6, "{:?}", coupled.tables.clamped_hz);
}

#[test]
fn one_matrix_in_six_encodings() {
    let Some(folder) = shared().map(|folder| folder.join("nastran-op4/encodings")) else { return };
    let read = |name: &str| read_matrices(&folder.join(name), None).unwrap_or_else(|error| panic!("{error}"));
    let first = read("mat_b_dn.op4");
    assert!(first.len() > 1);
    for name in ["mat_b_s1.op4", "mat_b_s2.op4", "mat_t_dn.op4", "mat_t_s1.op4", "mat_t_s2.op4"] {
        let other = read(name);
        assert_eq!(other.len(), first.len(), "{name}");
        for one in &first {
            let other = other.iter().find(|other| other.name == one.name).unwrap();
            assert_eq!(
                (&one.name, one.rows, one.columns),
                (&other.name, other.rows, other.columns),
                "{name}"
            );
            let sorted = |matrix: &hammerbeam_matrices::FileMatrix| {
                let mut entries: Vec<(u32, u32, u64)> =
                    matrix.entries.iter().map(|e| (e.column, e.row, e.value.to_bits())).collect();
                entries.sort_unstable();
                entries
            };
            assert!(sorted(one) == sorted(other), "{name} {}", one.name);
        }
    }
    let plate = read("testplate_kgg.op4");
    assert_eq!((plate[0].rows, plate[0].columns), (726, 726));
}

//! One file per command.

pub mod basins;
pub mod check;
pub mod compare;
pub mod completions;
pub mod export;
pub mod figure;
pub mod import;
pub mod lyapunov;
pub mod man;
pub mod modes;
pub mod new;
pub mod orbit;
pub mod overlay;
pub mod rig;
pub mod run;
pub mod signal;
pub mod simulate;
pub mod sweep;
pub mod update;
pub mod verify;

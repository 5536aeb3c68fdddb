//! One file per command.

pub mod check;
pub mod export;
pub mod modes;
pub mod new;
pub mod orbit;
pub mod run;
pub mod verify;

//! Ctrl-C and SIGTERM: what is finished is kept, and the command ends within a second.
//!
//! Commands look at the flag between pieces of work, end in order and say what is kept. A piece of work that
//! takes longer than [`PATIENCE`] (one period of a motion with millions of force steps, the eigenvalues of a
//! large matrix) cannot be waited for: then the process ends from beside. Nothing is lost by that but the
//! piece: results are written in transactions, and files are replaced whole.

use std::{
    process,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

use anyhow::Context;

use crate::{failure::Failure, output::Output};

/// Time in which a command is to end in order.
const PATIENCE: Duration = Duration::from_millis(800);

/// Whether the user has asked to stop.
#[derive(Debug, Clone)]
pub struct Interrupt {
    raised: Arc<AtomicBool>,
    /// Only short pieces of work are left, and are waited for.
    in_order: Arc<AtomicBool>,
}

impl Interrupt {
    /// Listens from now on; a second Ctrl-C ends the process at once.
    pub fn listen(output: Output) -> anyhow::Result<Self> {
        let interrupt = Self { raised: Arc::default(), in_order: Arc::default() };
        let heard = interrupt.clone();
        ctrlc::set_handler(move || {
            if heard.raised.swap(true, Ordering::SeqCst) {
                process::exit(130);
            }
            let heard = heard.clone();
            thread::spawn(move || heard.end_if_late(output));
        })
        .context("cannot listen to Ctrl-C")?;
        Ok(interrupt)
    }

    /// Whether the command is to stop.
    pub fn raised(&self) -> bool {
        self.raised.load(Ordering::SeqCst)
    }

    /// From now on pieces of work are short and end in order.
    pub fn is_in_order(&self) {
        self.in_order.store(true, Ordering::SeqCst);
    }

    fn end_if_late(&self, output: Output) {
        thread::sleep(PATIENCE);
        if !self.in_order.load(Ordering::SeqCst) {
            let message =
                "interrupted within a long computation; results folders keep what was stored before";
            let failure = Failure::Interrupted(message.to_owned());
            output.failure(&failure);
            process::exit(i32::from(failure.code()));
        }
    }
}

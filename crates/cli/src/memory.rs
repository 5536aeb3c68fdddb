//! Memory that cannot be had: a sentence and an exit code, where a program would be aborted.
//!
//! What was stored until then is in the results folder, since nothing is stored but by whole transactions.
#![expect(
    unsafe_code,
    reason = "an allocator is unsafe by its interface; this one only looks at what the system's returns"
)]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    io::{self, Write},
    process,
};

/// The allocator of the system, which ends the program with exit code 1 when it has nothing left.
pub struct OrExit;

#[global_allocator]
static ALLOCATOR: OrExit = OrExit;

// SAFETY: every call goes on to the allocator of the system with the same arguments.
unsafe impl GlobalAlloc for OrExit {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        or_exit(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        or_exit(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, old: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: as above.
        or_exit(unsafe { System.realloc(old, layout, size) }, size)
    }

    unsafe fn dealloc(&self, old: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(old, layout) }
    }
}

fn or_exit(memory: *mut u8, size: usize) -> *mut u8 {
    if memory.is_null() { refuse(size) } else { memory }
}

/// Says it without any memory.
#[cold]
fn refuse(size: usize) -> ! {
    let megabytes = size.div_ceil(1_000_000);
    let _ = writeln!(io::stderr(), "error: {megabytes} MB of memory cannot be had; what was stored is kept");
    process::exit(1)
}

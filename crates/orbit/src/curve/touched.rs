//! The contact that a grazing orbit touches; what is computed of it is in `grazing.rs`.

/// The contact that is touched.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub element: usize,
    pub contact: usize,
    /// Whether the contact is closed beside the touch.
    pub from_inside: bool,
}

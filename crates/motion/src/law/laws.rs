//! What the list of laws is made into.

/// Makes the enumeration of the laws, and `of_law!(it, law => call)`, which calls the law that it is.
macro_rules! laws {
    ($d:tt $($(#[$doc:meta])* $name:ident($law:ty),)+) => {
        /// The law of a local element.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Law {
            $($(#[$doc])* $name($law),)+
        }

        $(impl From<$law> for Law {
            fn from(law: $law) -> Self {
                Self::$name(law)
            }
        })+

        macro_rules! of_law {
            ($d it:expr, $d of:ident => $d call:expr) => {
                match $d it { $(Law::$name($d of) => $d call,)+ }
            };
        }
    };
}

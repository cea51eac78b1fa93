//! Status words: a name for each bit.

/// A status word of some bits with a constant for each, and its `Debug` form, which lists the names of
/// the bits that are set.
macro_rules! status_word {
    ($(#[$doc:meta])* $name:ident($word:ty) {
        $($bit:ident = $number:literal, $meaning:literal;)*
    }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Default)]
        pub struct $name(pub $word);

        impl $name {
            $(
                #[doc = concat!("Bit ", $number, ": ", $meaning, ".")]
                pub const $bit: $name = $name(1 << $number);
            )*

            /// The bits that have a name, lowest first.
            pub const NAMED: &'static [(&'static str, $name)] =
                &[$((stringify!($bit), $name::$bit),)*];

            /// Whether all bits of another word are set in this one.
            #[must_use]
            pub const fn has(self, other: $name) -> bool {
                self.0 & other.0 == other.0
            }

            /// This word with the bits of another set if a condition holds.
            #[must_use]
            pub const fn with(self, other: $name, condition: bool) -> $name {
                if condition { $name(self.0 | other.0) } else { self }
            }
        }

        impl std::ops::BitOr for $name {
            type Output = $name;

            fn bitor(self, other: $name) -> $name {
                $name(self.0 | other.0)
            }
        }

        impl std::fmt::Debug for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let digits = std::mem::size_of::<$word>() * 2;
                write!(f, concat!(stringify!($name), "({:0width$X}"), self.0, width = digits)?;
                for (name, _) in Self::NAMED.iter().filter(|(_, bit)| self.has(*bit)) {
                    write!(f, " {name}")?;
                }
                f.write_str(")")
            }
        }
    };
}

pub(super) use status_word;

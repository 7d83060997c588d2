//! Enums whose variants are words of `case.toml`.

/// A closed set of words of `case.toml`; schema, reader and printed plan all take them from here.
pub trait Word: Copy + 'static {
    /// The words as written in the file, in the order of the variants.
    const WORDS: &'static [&'static str];

    /// The word as written in the file.
    fn word(self) -> &'static str;

    /// The variant of a word.
    fn from_word(word: &str) -> Option<Self>;
}

/// Declares an enum together with the words its variants are written as.
macro_rules! words {
    ($(#[$attribute:meta])* $visibility:vis enum $name:ident {
        $($(#[$variant_attribute:meta])* $variant:ident = $word:literal,)+
    }) => {
        $(#[$attribute])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        $visibility enum $name {
            $($(#[$variant_attribute])* #[doc = concat!(" Written `\"", $word, "\"`.")] $variant,)+
        }

        impl $crate::words::Word for $name {
            const WORDS: &'static [&'static str] = &[$($word),+];

            fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)+ }
            }

            fn from_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)+ _ => None }
            }
        }
    };
}

pub(crate) use words;

//! What a number in a file means.

/// Name, unit, formula and source of a quantity, to be written beside its values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Name in files.
    pub name: &'static str,
    /// SI unit, empty for pure numbers.
    pub unit: &'static str,
    /// How it is computed.
    pub formula: &'static str,
    /// Where the definition stems from; empty where it needs none.
    pub source: &'static str,
}

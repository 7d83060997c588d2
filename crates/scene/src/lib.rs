//! case.toml to a validated scene in SI units.

//! vaso tests.

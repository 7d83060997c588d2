//! Text to SI numbers with dimensions, and back.

//! From a vessel surface to relaxed fluid and wall particles.

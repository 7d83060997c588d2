//! vaso cases.

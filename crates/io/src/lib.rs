//! VTKHDF series, tables, summaries and caches on disk.

//! Inlets and outlets through bidirectional buffers.

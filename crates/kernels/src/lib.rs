//! Smoothing kernels, neighbour rows and the pair loops.

//! insd-alignment

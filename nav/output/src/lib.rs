//! insd-output

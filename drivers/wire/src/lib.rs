//! insd-wire

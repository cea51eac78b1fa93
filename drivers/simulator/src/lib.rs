//! insd-simulator

//! insd-tests

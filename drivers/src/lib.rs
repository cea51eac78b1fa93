//! insd-drivers

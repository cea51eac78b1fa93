//! insd-nav

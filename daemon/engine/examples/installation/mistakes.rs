//! The mistakes of an installer that only the sea shows.

use insd_base::{Body, VoyageHeader};

/// A configuration that is wrong.
pub(crate) struct Mistake {
    pub(crate) name: &'static str,
    pub(crate) make: fn(&mut VoyageHeader),
}

fn lever(header: &mut VoyageHeader, change: impl Fn([f64; 3]) -> [f64; 3]) {
    let [forward, starboard, down] = change(header.lever_arms.gnss.0.into());
    header.lever_arms.gnss = Body::new(forward, starboard, down);
}

/// All of them; the first is none.
pub(crate) const MISTAKES: [Mistake; 9] = [
    Mistake { name: "as configured", make: |_| {} },
    Mistake { name: "down sign", make: |h| lever(h, |[x, y, z]| [x, y, -z]) },
    Mistake { name: "forward sign", make: |h| lever(h, |[x, y, z]| [-x, y, z]) },
    Mistake { name: "all signs", make: |h| lever(h, |[x, y, z]| [-x, -y, -z]) },
    Mistake { name: "ten times", make: |h| lever(h, |[x, y, z]| [10.0 * x, 10.0 * y, 10.0 * z]) },
    Mistake { name: "axes swapped", make: |h| lever(h, |[x, y, z]| [y, x, z]) },
    Mistake {
        name: "feet for metres",
        make: |h| lever(h, |[x, y, z]| [x * 3.28, y * 3.28, z * 3.28]),
    },
    Mistake { name: "not measured", make: |h| lever(h, |_| [0.0; 3]) },
    Mistake { name: "log lever sign", make: |h| h.lever_arms.log.0 = -h.lever_arms.log.0 },
];

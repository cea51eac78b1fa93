//! The part of the ship that touches the quay.

use insd_base::Body;

use super::types::HullPart;

/// The side of the ship, from the IMU, body axes, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Hull {
    /// Corners of the outline at the height of the fenders: forward, starboard. Without any the points below are those of her side.
    pub outline: Vec<[f64; 2]>,
    /// Where her side begins forward.
    pub bow: Body,
    /// Where it ends aft.
    pub stern: Body,
    /// Where she takes and gives her cargo, if that is told of.
    pub manifold: Option<Body>,
}

impl Hull {
    /// A point as it was told.
    #[must_use]
    pub fn told(&self, part: HullPart) -> Option<Body> {
        match part {
            HullPart::Bow => Some(self.bow),
            HullPart::Stern => Some(self.stern),
            HullPart::Manifold => self.manifold,
        }
    }

    /// Where the hull is at the station of a part: on both sides, or the point itself where there is no outline. None of a part
    /// that she has not.
    pub(super) fn sides(&self, part: HullPart) -> Vec<Body> {
        let Some(told) = self.told(part) else { return Vec::new() };
        let cuts = self.cuts(told.0.x);
        let ends = cuts.iter().copied().reduce(f64::min).zip(cuts.iter().copied().reduce(f64::max));
        match ends {
            Some((port, starboard)) => {
                [port, starboard].map(|side| Body::new(told.0.x, side, told.0.z)).to_vec()
            }
            None => vec![told],
        }
    }

    /// Where the outline crosses a station.
    fn cuts(&self, forward: f64) -> Vec<f64> {
        let next = self.outline.iter().cycle().skip(1);
        let cut = |(one, other): (&[f64; 2], &[f64; 2])| {
            let (before, after) = (one[0] - forward, other[0] - forward);
            if before == 0.0 {
                return Some(one[1]);
            }
            (before * after < 0.0).then(|| one[1] + (other[1] - one[1]) * before / (before - after))
        };
        self.outline.iter().zip(next).filter_map(cut).collect()
    }

    /// The corners, each with the part of the ship that it belongs to: the fore or the after third of her side, or what lies
    /// between.
    pub(super) fn corners(&self) -> impl Iterator<Item = (HullPart, Body)> + '_ {
        let (bow, stern) = (self.bow.0, self.stern.0);
        let third = (bow.x - stern.x) / 3.0;
        let down = (bow.z + stern.z) / 2.0;
        self.outline.iter().map(move |[forward, starboard]| {
            let part = if *forward >= bow.x - third {
                HullPart::Bow
            } else if *forward <= stern.x + third {
                HullPart::Stern
            } else {
                HullPart::Manifold
            };
            (part, Body::new(*forward, *starboard, down))
        })
    }
}

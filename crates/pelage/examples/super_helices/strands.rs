//! Strands to be fitted, by formula: none of them is a Super-Helix of few elements, but for
//! what a coil is in its middle.

use pelage::curves::DVec3;
use std::f64::consts::TAU;

/// A kind of hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Falls in one bend.
    Straight,
    /// Waves in a plane that turns slowly, wider towards the tip.
    Wavy,
    /// A few loose turns, whose radius and pitch change.
    Curly,
    /// Many tight turns about a bent line.
    Coiled,
    /// A loose overhand knot.
    Knotted,
}

impl Kind {
    pub const ALL: [Self; 5] = [
        Self::Straight,
        Self::Wavy,
        Self::Curly,
        Self::Coiled,
        Self::Knotted,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Straight => "straight",
            Self::Wavy => "wavy",
            Self::Curly => "curly",
            Self::Coiled => "coiled",
            Self::Knotted => "knotted",
        }
    }

    /// `count` points, two at least, of hair number `index`.
    pub fn strand(self, index: u32, count: usize) -> Vec<DVec3> {
        let vary = |channel: u32| 0.8 + 0.4 * random(index, channel);
        let point = |i: usize| {
            let t = i as f64 / (count - 1) as f64;
            self.at(t, vary)
        };
        (0..count).map(point).collect()
    }

    /// The place at `t` in 0..=1; `vary` is a number near 1 for each channel.
    fn at(self, t: f64, vary: impl Fn(u32) -> f64) -> DVec3 {
        let (sin, cos) = (libm::sin, libm::cos);
        // The line that the hair goes along: a fall to the side.
        let droop = DVec3::new(0.25 * vary(0) * t * t, 0.1 * vary(1) * t * t * t, -t);
        match self {
            Self::Straight => droop,
            Self::Wavy => {
                let phase = TAU * 4.0 * vary(2) * t + 0.6 * sin(3.0 * vary(3) * t);
                let plane = 0.8 * vary(4) * t;
                let size = 0.045 * vary(5) * (0.2 + t);
                droop + DVec3::new(cos(plane), sin(plane), 0.0) * (size * sin(phase))
            }
            Self::Curly => {
                let phase = TAU * 4.0 * vary(2) * t * (0.8 + 0.3 * t);
                let size = 0.06 * vary(5) * (0.3 + t) * (1.0 + 0.2 * sin(7.0 * vary(6) * t));
                droop + DVec3::new(cos(phase) - 1.0, sin(phase), 0.0) * size
            }
            Self::Coiled => {
                let phase = TAU * 10.0 * vary(2) * t;
                let size = 0.04 * vary(5) * (1.0 + 0.1 * sin(5.0 * vary(6) * t));
                droop + DVec3::new(cos(phase) - 1.0, sin(phase), 0.2 * sin(4.0 * t)) * size
            }
            Self::Knotted => {
                // A trefoil, opened where it is pulled out to both ends.
                let u = TAU * (0.04 + 0.92 * t);
                let knot = DVec3::new(
                    sin(u) + 2.0 * sin(2.0 * u),
                    cos(u) - 2.0 * cos(2.0 * u),
                    -vary(2) * sin(3.0 * u),
                );
                let out = 2.0 * t - 1.0;
                knot * 0.1 + DVec3::new(0.0, 0.5 * out * out * out, 0.1 * out)
            }
        }
    }
}

/// A number in 0..1 of a hair and a channel (the finalizer of MurmurHash3).
fn random(index: u32, channel: u32) -> f64 {
    let mut h = index.wrapping_mul(0x9e37_79b9) ^ channel.wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    f64::from(h ^ (h >> 16)) / 4_294_967_296.0
}

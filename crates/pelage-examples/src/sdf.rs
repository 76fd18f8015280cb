//! Solids as signed distance: round cones and ellipsoids melted together.
//!
//! The primitives and the cubic smooth minimum are Inigo Quilez's well-known
//! forms ("Distance functions", "Smooth minimum"). Ellipsoids and flattened
//! cones are bounds rather than exact distances; whoever walks to the surface
//! takes Newton steps ([`Solid::project`]).

use glam::{DMat3, DVec3};

/// A simple convex body.
#[derive(Clone, Copy, Debug)]
pub enum Primitive {
    /// The hull of two spheres.
    RoundCone {
        /// Centre of the first sphere.
        a: DVec3,
        /// Centre of the second sphere.
        b: DVec3,
        /// Radius of the first sphere.
        ra: f64,
        /// Radius of the second sphere.
        rb: f64,
    },
    /// A round cone pressed flat along an axis: ears.
    Leaf {
        /// Centre of the first sphere.
        a: DVec3,
        /// Centre of the second sphere.
        b: DVec3,
        /// Radius of the first sphere, before pressing.
        ra: f64,
        /// Radius of the second sphere, before pressing.
        rb: f64,
        /// Unit axis along which the body is pressed.
        flat: DVec3,
        /// Thickness is divided by this, ≥ 1.
        press: f64,
    },
    /// An ellipsoid.
    Ellipsoid {
        /// Centre.
        center: DVec3,
        /// Half axes.
        radii: DVec3,
        /// Turns world directions into the axes' frame.
        local_from_world: DMat3,
    },
}

/// A round cone; see [`Primitive::RoundCone`].
pub fn cone(a: [f64; 3], ra: f64, b: [f64; 3], rb: f64) -> Primitive {
    Primitive::RoundCone {
        a: a.into(),
        b: b.into(),
        ra,
        rb,
    }
}

/// An ellipsoid with axes along x, y, z.
pub fn ellipsoid(center: [f64; 3], radii: [f64; 3]) -> Primitive {
    Primitive::Ellipsoid {
        center: center.into(),
        radii: radii.into(),
        local_from_world: DMat3::IDENTITY,
    }
}

/// A sphere.
pub fn sphere(center: [f64; 3], radius: f64) -> Primitive {
    ellipsoid(center, [radius; 3])
}

/// A turn about the x axis by `degrees`, with the crate's own sine and cosine.
pub fn turn_x(degrees: f64) -> DMat3 {
    let (s, c) = libm::sincos(degrees.to_radians());
    DMat3::from_cols(DVec3::X, DVec3::new(0.0, c, s), DVec3::new(0.0, -s, c))
}

/// A turn about the z axis by `degrees`.
pub fn turn_z(degrees: f64) -> DMat3 {
    let (s, c) = libm::sincos(degrees.to_radians());
    DMat3::from_cols(DVec3::new(c, s, 0.0), DVec3::new(-s, c, 0.0), DVec3::Z)
}

impl Primitive {
    /// Signed distance (or a bound of it), negative inside.
    pub fn distance(&self, p: DVec3) -> f64 {
        match *self {
            Self::RoundCone { a, b, ra, rb } => round_cone(p, a, b, ra, rb),
            Self::Leaf {
                a,
                b,
                ra,
                rb,
                flat,
                press,
            } => {
                let stretched = p + flat * ((p - a).dot(flat) * (press - 1.0));
                round_cone(stretched, a, b, ra, rb) / press
            }
            Self::Ellipsoid {
                center,
                radii,
                local_from_world,
            } => {
                let q = local_from_world * (p - center);
                let k0 = (q / radii).length();
                let k1 = (q / (radii * radii)).length();
                if k1 < 1e-12 {
                    return -radii.min_element();
                }
                k0 * (k0 - 1.0) / k1
            }
        }
    }

    /// Centre and radius of a ball around the body.
    fn ball(&self) -> (DVec3, f64) {
        match *self {
            Self::RoundCone { a, b, ra, rb } | Self::Leaf { a, b, ra, rb, .. } => {
                ((a + b) * 0.5, 0.5 * a.distance(b) + ra.max(rb))
            }
            Self::Ellipsoid { center, radii, .. } => (center, radii.max_element()),
        }
    }

    /// The same body on the other side of the plane x = 0.
    pub fn mirrored(&self) -> Self {
        let m = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
        let flip = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        match *self {
            Self::RoundCone { a, b, ra, rb } => Self::RoundCone {
                a: m(a),
                b: m(b),
                ra,
                rb,
            },
            Self::Leaf {
                a,
                b,
                ra,
                rb,
                flat,
                press,
            } => Self::Leaf {
                a: m(a),
                b: m(b),
                ra,
                rb,
                flat: m(flat),
                press,
            },
            Self::Ellipsoid {
                center,
                radii,
                local_from_world,
            } => Self::Ellipsoid {
                center: m(center),
                radii,
                local_from_world: local_from_world * flip,
            },
        }
    }
}

/// Exact distance to the hull of two spheres.
fn round_cone(p: DVec3, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64 {
    let ba = b - a;
    let l2 = ba.length_squared();
    let rr = ra - rb;
    let a2 = l2 - rr * rr;
    let il2 = 1.0 / l2;
    let pa = p - a;
    let y = pa.dot(ba);
    let z = y - l2;
    let x2 = (pa * l2 - ba * y).length_squared();
    let (y2, z2) = (y * y * l2, z * z * l2);
    let k = rr.signum() * rr * rr * x2;
    if z.signum() * a2 * z2 > k {
        return (x2 + z2).sqrt() * il2 - rb;
    }
    if y.signum() * a2 * y2 < k {
        return (x2 + y2).sqrt() * il2 - ra;
    }
    ((x2 * a2 * il2).sqrt() + y * rr) * il2 - ra
}

/// Minimum of `a` and `b`, rounded where they differ by less than `k`.
pub fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = ((k - (a - b).abs()) / k).max(0.0);
    a.min(b) - h * h * h * k / 6.0
}

/// One primitive of a [`Solid`].
#[derive(Clone, Copy, Debug)]
pub struct Blob<P> {
    /// Its body.
    pub primitive: Primitive,
    /// Width of the fillet where it meets what came before.
    pub blend: f64,
    /// Whether it is taken away rather than added.
    pub carved: bool,
    /// What it belongs to.
    pub part: P,
    /// Centre and radius of a ball around the body.
    ball: (DVec3, f64),
}

/// Blobs, melted together in their order.
#[derive(Clone, Debug)]
pub struct Solid<P> {
    /// The blobs.
    pub blobs: Vec<Blob<P>>,
    /// The solid ends below this height, with an edge this much rounded.
    pub floor: Option<(f64, f64)>,
}

impl<P: Copy + PartialEq> Solid<P> {
    /// Nothing yet.
    pub fn new() -> Self {
        Self {
            blobs: Vec::new(),
            floor: None,
        }
    }

    /// Adds a body.
    pub fn add(&mut self, part: P, blend: f64, primitive: Primitive) {
        self.blobs.push(Blob {
            primitive,
            blend,
            carved: false,
            part,
            ball: primitive.ball(),
        });
    }

    /// Takes a body away.
    pub fn carve(&mut self, part: P, blend: f64, primitive: Primitive) {
        self.blobs.push(Blob {
            primitive,
            blend,
            carved: true,
            part,
            ball: primitive.ball(),
        });
    }

    /// Signed distance to the surface (near it; further away a bound).
    pub fn distance(&self, p: DVec3) -> f64 {
        let mut d = f64::MAX / 4.0;
        for blob in &self.blobs {
            let (center, radius) = blob.ball;
            let reach = blob.blend + radius + if blob.carved { -d } else { d };
            // Too far to matter, even where a bound is half the true distance.
            if reach > 0.0 && center.distance_squared(p) > 4.0 * reach * reach {
                continue;
            }
            let own = blob.primitive.distance(p);
            d = if blob.carved {
                -smooth_min(-d, own, blob.blend)
            } else {
                smooth_min(d, own, blob.blend)
            };
        }
        match self.floor {
            Some((height, blend)) => -smooth_min(-d, p.y - height, blend),
            None => d,
        }
    }

    /// Gradient of the distance by differences to the corners of a tetrahedron
    /// (Quilez, "Normals for an SDF"): four evaluations, no preferred axis.
    pub fn gradient(&self, p: DVec3) -> DVec3 {
        // The step is far above f64 rounding and far below any feature.
        const STEP: f64 = 1e-5;
        const CORNERS: [DVec3; 4] = [
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, 1.0, 1.0),
        ];
        let sum: DVec3 = CORNERS
            .map(|c| c * self.distance(p + c * STEP))
            .iter()
            .sum();
        sum / (4.0 * STEP)
    }

    /// Unit outward normal near the surface.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        self.gradient(p).try_normalize().unwrap_or(DVec3::Y)
    }

    /// Walks to the surface in at most `steps` Newton steps along the gradient.
    pub fn project(&self, mut p: DVec3, steps: usize) -> DVec3 {
        for _ in 0..steps {
            let d = self.distance(p);
            if d.abs() < 1e-9 {
                break;
            }
            let g = self.gradient(p);
            p -= g * (d / g.length_squared().max(1e-3));
        }
        p
    }

    /// How near `part` is: the least distance to one of its added bodies.
    pub fn part_distance(&self, p: DVec3, is_part: impl Fn(P) -> bool) -> f64 {
        self.blobs
            .iter()
            .filter(|b| !b.carved && is_part(b.part))
            .map(|b| b.primitive.distance(p))
            .fold(f64::MAX, f64::min)
    }

    /// The part whose body is nearest.
    pub fn nearest_part(&self, p: DVec3) -> Option<P> {
        let mut best = (f64::MAX, None);
        for blob in self.blobs.iter().filter(|b| !b.carved) {
            let d = blob.primitive.distance(p);
            if d < best.0 {
                best = (d, Some(blob.part));
            }
        }
        best.1
    }
}

impl<P: Copy + PartialEq> Default for Solid<P> {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_cone_is_zero_on_its_spheres_and_cone() {
        let body = cone([0.0; 3], 0.5, [0.0, 2.0, 0.0], 0.2);
        assert!(body.distance(DVec3::new(0.0, -0.5, 0.0)).abs() < 1e-12);
        assert!(body.distance(DVec3::new(0.0, 2.2, 0.0)).abs() < 1e-12);
        assert!((body.distance(DVec3::ZERO) + 0.5).abs() < 0.05);
    }

    #[test]
    fn projected_points_lie_on_the_surface() {
        let mut solid = Solid::new();
        solid.add((), 0.1, sphere([0.0; 3], 0.5));
        solid.add((), 0.1, ellipsoid([0.4, 0.0, 0.0], [0.4, 0.2, 0.3]));
        for i in 0..50 {
            let a = i as f64 * 0.7;
            let start = DVec3::new(libm::cos(a), libm::sin(a), libm::cos(a * 0.3)) * 0.6;
            assert!(solid.distance(solid.project(start, 20)).abs() < 1e-8);
        }
    }

    #[test]
    fn mirroring_twice_changes_nothing() {
        let body = ellipsoid([0.3, 0.1, 0.0], [0.1, 0.2, 0.3]);
        let p = DVec3::new(0.2, 0.5, 0.1);
        assert_eq!(body.mirrored().mirrored().distance(p), body.distance(p));
        let opposite = DVec3::new(-0.2, 0.5, 0.1);
        assert_eq!(body.mirrored().distance(opposite), body.distance(p));
    }
}
